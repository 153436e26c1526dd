/// SDO client and server against random frames and against each other over a bad bus. Under the sanitizers
/// (debug preset) this also shows that nothing is read or written out of bounds.
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <random>
#include <vector>

#include "drivers/canopen/sdo_client.h"
#include "drivers/canopen/sdo_server.h"

namespace sprung::canopen {
namespace {

constexpr int kNode = 6;
constexpr int kRandomFrames = 200'000;
constexpr ObjectId kObject{0x2100, 1};

/// One object of any length.
struct OneObject : SdoObjects {
  std::vector<std::uint8_t> value = std::vector<std::uint8_t>(kMaxTransfer);
  std::size_t size = 0;
  int writes = 0;

  std::uint32_t read(ObjectId, std::uint8_t* bytes, std::size_t capacity,
                     std::size_t& used) noexcept override {
    EXPECT_EQ(capacity, kMaxTransfer);
    used = size;
    std::copy_n(value.begin(), size, bytes);
    return 0;
  }
  std::uint32_t write(ObjectId, const std::uint8_t* bytes, std::size_t count, bool) noexcept override {
    EXPECT_LE(count, kMaxTransfer);
    size = count;
    std::copy_n(bytes, count, value.begin());
    ++writes;
    return 0;
  }
};

/// Half of them with a sensible command, so that transfers begin and go on.
CanFrame random_frame(std::mt19937& random, std::uint32_t id) {
  constexpr std::array<std::uint8_t, 26> kCommands = {0x00, 0x10, 0x01, 0x11, 0x20, 0x21, 0x30, 0x40, 0x41,
                                                      0x43, 0x60, 0x70, 0x80, 0x0E, 0xA0, 0xA1, 0xA2, 0xA3,
                                                      0xA4, 0xC2, 0xC6, 0xC5, 0x01, 0x02, 0x81, 0x82};
  CanFrame frame;
  frame.id = random() % 16 == 0 ? random() & 0x7FF : id;
  frame.length = static_cast<std::uint8_t>(random() % 32 == 0 ? random() % 9 : 8);
  for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random());
  if (random() % 2 == 0) frame.data[0] = kCommands[random() % kCommands.size()];
  if (random() % 2 == 0) {
    put_le(&frame.data[1], kObject.index, 2);
    frame.data[3] = kObject.sub;
  }
  if (random() % 2 == 0) put_le(&frame.data[4], random() % (2 * kMaxTransfer), 4);
  frame.remote = random() % 64 == 0;
  frame.error = random() % 64 == 0;
  return frame;
}

TEST(SdoFuzz, ServerAnswersEveryRandomRequestAndStaysWithinItsBuffer) {
  std::mt19937 random(1);
  OneObject object;
  SdoServer server(kNode, object, 1000);
  CanFrame reply;
  int segments = 0, of_blocks = 0;
  for (int i = 0; i < kRandomFrames; ++i) {
    const CanFrame request = random_frame(random, sdo_client_id(kNode));
    object.size = random() % (kMaxTransfer + 1);
    for (int more = 0; more < 3 && server.step(i, reply); ++more, ++of_blocks)
      EXPECT_EQ(reply.id, sdo_server_id(kNode));
    if (!server.receive(request, i, reply)) continue;
    EXPECT_EQ(reply.id, sdo_server_id(kNode));
    const SdoKind kind = decode_sdo_reply(reply).kind;
    EXPECT_NE(kind, SdoKind::kInvalid);
    EXPECT_NE(kind, SdoKind::kUnsupported);
    segments += kind == SdoKind::kUploadSegment || kind == SdoKind::kDownloadSegment ? 1 : 0;
  }
  EXPECT_GT(object.writes, 100);
  EXPECT_GT(segments, 300) << "the frames must reach the segments";
  EXPECT_GT(of_blocks, 100) << "and the blocks";
}

/// What was asked is random too.
void begin(SdoClient& client, std::mt19937& random) {
  const std::vector<std::uint8_t> bytes(random() % 80, 0xA5);
  const SdoService service = random() % 2 == 0 ? SdoService::kBlock : SdoService::kPlain;
  switch (random() % 3) {
    case 0:
      return client.read(kObject, service);
    case 1:
      return client.write(kObject, static_cast<std::uint32_t>(random()), 1 + static_cast<int>(random() % 4));
    default:
      return client.write(kObject, bytes.data(), bytes.size(), service);
  }
}

TEST(SdoFuzz, ClientEndsEveryTransferWhateverComes) {
  std::mt19937 random(2);
  SdoClient client(kNode, 50);
  std::array<int, 5> ends{};
  CanFrame request;
  for (int i = 0; i < kRandomFrames; ++i) {
    if (client.idle()) begin(client, random);
    while (client.step(i, request)) ASSERT_EQ(request.id, sdo_client_id(kNode));
    // Sometimes nothing comes for longer than the time-out.
    if ((i / 200) % 8 != 0) client.receive(random_frame(random, sdo_server_id(kNode)));
    ASSERT_LE(client.size(), kMaxTransfer);
    if (client.status() == SdoStatus::kBusy) continue;
    ++ends[static_cast<std::size_t>(client.status())];
    client.finish();
  }
  EXPECT_GT(ends[static_cast<std::size_t>(SdoStatus::kDone)], 100);
  EXPECT_GT(ends[static_cast<std::size_t>(SdoStatus::kAborted)], 100);
  EXPECT_GT(ends[static_cast<std::size_t>(SdoStatus::kTimeout)], 5);
}

/// Frames that are on their way; some are lost, some come twice.
class BadBus {
 public:
  BadBus(unsigned seed, int fault_permille) : random_(seed), fault_permille_(fault_permille) {}
  void send(const CanFrame& frame) {
    if (faulty()) return;
    queue_.push_back(frame);
    if (faulty()) queue_.push_back(frame);
  }
  bool receive(CanFrame& frame) {
    if (queue_.empty()) return false;
    frame = queue_.front();
    queue_.pop_front();
    return true;
  }

 private:
  bool faulty() { return static_cast<int>(random_() % 1000) < fault_permille_; }
  std::mt19937 random_;
  int fault_permille_;
  std::deque<CanFrame> queue_;
};

struct Pair {
  explicit Pair(int fault_permille)
      : requests(3, fault_permille),
        replies(4, fault_permille),
        client(kNode, 20),
        server(kNode, object, 15) {}

  /// One transfer to its end. @return false when it has none.
  bool finish_transfer() {
    for (int step = 0; step < 5000 && client.status() == SdoStatus::kBusy; ++step, ++time_us) {
      CanFrame frame, reply;
      while (client.step(time_us, frame)) requests.send(frame);
      while (requests.receive(frame)) {
        if (server.receive(frame, time_us, reply)) replies.send(reply);
      }
      while (server.step(time_us, reply)) replies.send(reply);
      while (replies.receive(frame)) client.receive(frame);
    }
    return client.status() != SdoStatus::kBusy;
  }

  BadBus requests, replies;
  OneObject object;
  SdoClient client;
  SdoServer server;
  std::int64_t time_us = 0;
};

std::vector<std::uint8_t> random_bytes(std::mt19937& random, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

class SdoPair : public testing::TestWithParam<SdoService> {};

TEST_P(SdoPair, EveryLengthIsWrittenAndReadBackUnchanged) {
  std::mt19937 random(5);
  Pair pair(0);
  for (std::size_t size = 0; size <= kMaxTransfer; size += size < 40 ? 1 : 41) {
    const std::vector<std::uint8_t> sent = random_bytes(random, size);
    pair.client.write(kObject, sent.data(), sent.size(), GetParam());
    ASSERT_TRUE(pair.finish_transfer());
    ASSERT_EQ(pair.client.status(), SdoStatus::kDone) << size;
    pair.client.read(kObject, GetParam());
    ASSERT_TRUE(pair.finish_transfer());
    ASSERT_EQ(pair.client.status(), SdoStatus::kDone) << size;
    ASSERT_EQ(std::vector<std::uint8_t>(pair.client.data(), pair.client.data() + pair.client.size()), sent);
    EXPECT_FALSE(pair.server.busy());
  }
}

TEST_P(SdoPair, OverABadBusEveryTransferEndsAndWhatIsDoneIsRight) {
  std::mt19937 random(6);
  Pair pair(10);
  int done = 0, failed = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<std::uint8_t> sent = random_bytes(random, random() % 60);
    pair.client.write(kObject, sent.data(), sent.size(), GetParam());
    ASSERT_TRUE(pair.finish_transfer()) << i;
    if (pair.client.status() != SdoStatus::kDone) {
      ++failed;
      continue;
    }
    ++done;
    const std::vector<std::uint8_t> held(
        pair.object.value.begin(), pair.object.value.begin() + static_cast<std::ptrdiff_t>(pair.object.size));
    ASSERT_EQ(held, sent) << i;
    pair.client.read(kObject, GetParam());
    ASSERT_TRUE(pair.finish_transfer()) << i;
    if (pair.client.status() != SdoStatus::kDone) continue;
    ASSERT_EQ(std::vector<std::uint8_t>(pair.client.data(), pair.client.data() + pair.client.size()), sent)
        << i;
  }
  EXPECT_GT(done, 2000);
  EXPECT_GT(failed, 10) << "the bus must have been bad enough to show something";
}

INSTANTIATE_TEST_SUITE_P(Services, SdoPair, testing::Values(SdoService::kPlain, SdoService::kBlock));

/// Blocks of all sizes that have 127 segments and more, with losses.
TEST(SdoPairBlocks, LongValuesSurviveLosses) {
  std::mt19937 random(7);
  Pair pair(3);
  int done = 0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<std::uint8_t> sent = random_bytes(random, 800 + random() % 4000);
    pair.client.write(kObject, sent.data(), sent.size(), SdoService::kBlock);
    ASSERT_TRUE(pair.finish_transfer()) << i;
    if (pair.client.status() != SdoStatus::kDone) continue;
    pair.client.read(kObject, SdoService::kBlock);
    ASSERT_TRUE(pair.finish_transfer()) << i;
    if (pair.client.status() != SdoStatus::kDone) continue;
    ++done;
    ASSERT_EQ(std::vector<std::uint8_t>(pair.client.data(), pair.client.data() + pair.client.size()), sent)
        << i;
  }
  EXPECT_GT(done, 100);
}

}  // namespace
}  // namespace sprung::canopen
