#include "tools/logs/replay/batch_ring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace sprung {
namespace {

using Batch = std::vector<int>;

TEST(BatchRing, BatchesComeInOrderAndNeverMoreThanThePlaces) {
  constexpr int kCount = 20'000, kPlaces = 3;
  BatchRing<Batch> ring(kPlaces);
  std::atomic<int> given_back{0};
  int most_ahead = 0;
  std::thread writer([&] {
    for (int i = 0; i < kCount; ++i) {
      Batch* const batch = ring.place();
      most_ahead = std::max(most_ahead, i + 1 - given_back.load());
      batch->assign(3, i);
      ring.hand_over();
    }
    ring.close();
  });
  int expected = 0;
  while (const Batch* const batch = ring.front()) {
    ASSERT_EQ(*batch, Batch(3, expected));
    ++expected;
    ++given_back;  // before it is: the writer may see one place too many, never one too few
    ring.give_back();
  }
  writer.join();
  EXPECT_EQ(expected, kCount);
  EXPECT_LE(most_ahead, kPlaces);
}

TEST(BatchRing, PlacesAreUsedAgainAsTheReaderLeftThem) {
  BatchRing<Batch> ring(2, Batch(5, 7));
  std::set<const Batch*> places;
  for (int i = 0; i < 10; ++i) {
    Batch* const batch = ring.place();
    places.insert(batch);
    EXPECT_EQ(*batch, i < 2 ? Batch(5, 7) : Batch(1, i - 2));
    ring.hand_over();
    ring.front()->assign(1, i);
    ring.give_back();
  }
  EXPECT_EQ(places.size(), 2u);
}

TEST(BatchRing, FrontIsTheSameUntilItIsGivenBack) {
  BatchRing<Batch> ring(2);
  for (const int value : {1, 2}) {
    ring.place()->assign(1, value);
    ring.hand_over();
  }
  EXPECT_EQ(ring.front()->front(), 1);
  EXPECT_EQ(ring.front()->front(), 1);
  ring.give_back();
  EXPECT_EQ(ring.front()->front(), 2);
}

TEST(BatchRing, ErrorOfTheWriterComesBehindItsLastBatch) {
  BatchRing<Batch> ring(4);
  for (int i = 0; i < 2; ++i) {
    ring.place()->assign(1, i);
    ring.hand_over();
  }
  ring.close(std::make_exception_ptr(std::invalid_argument("the third")));
  for (int i = 0; i < 2; ++i) {
    ASSERT_NE(ring.front(), nullptr);
    EXPECT_EQ(ring.front()->front(), i);
    ring.give_back();
  }
  for (int again = 0; again < 2; ++again) {
    try {
      ring.front();
      FAIL();
    } catch (const std::invalid_argument& error) {
      EXPECT_STREQ(error.what(), "the third");
    }
  }
}

TEST(BatchRing, EndIsAnEndAgainAndAgain) {
  BatchRing<Batch> ring(1);
  ring.close();
  EXPECT_EQ(ring.front(), nullptr);
  EXPECT_EQ(ring.front(), nullptr);
}

/// Both would hang for good if the other side did not wake them.
TEST(BatchRing, WriterThatWaitsForAPlaceGoesOnWhenTheReaderStops) {
  for (int run = 0; run < 200; ++run) {
    BatchRing<Batch> ring(2);
    int placed = 0;
    std::thread writer([&] {
      for (; ring.place() != nullptr; ring.hand_over()) ++placed;
    });
    if (run % 2 == 0) {
      EXPECT_NE(ring.front(), nullptr);
    }
    ring.stop();
    writer.join();
    EXPECT_LE(placed, 2);
    EXPECT_EQ(ring.place(), nullptr);
  }
}

TEST(BatchRing, ReaderThatWaitsForABatchGoesOnWhenTheWriterEnds) {
  for (int run = 0; run < 200; ++run) {
    BatchRing<Batch> ring(2);
    const Batch none;
    const Batch* seen = &none;
    std::thread reader([&] { seen = ring.front(); });
    ring.close();
    reader.join();
    EXPECT_EQ(seen, nullptr);
  }
}

}  // namespace
}  // namespace sprung
