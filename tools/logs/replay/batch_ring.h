#pragma once
/// Batches on their way from one thread to another, in order. Each has a place that is used again, with the
/// memory that it has by then, and there are never more than those places. One thread writes, one reads.
///
///   writer: while (Batch* batch = ring.place()) { fill(*batch); ring.hand_over(); }  ring.close();
///   reader: while (Batch* batch = ring.front()) { use(*batch); ring.give_back(); }
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <utility>
#include <vector>

namespace sprung {

template <class Batch>
class BatchRing {
 public:
  /// @param places at least 1. @param prototype of what stands in each at first.
  explicit BatchRing(std::size_t places, const Batch& prototype = Batch()) : batches_(places, prototype) {}
  BatchRing(const BatchRing&) = delete;
  BatchRing& operator=(const BatchRing&) = delete;

  /// Writer: the place of the next batch, as the reader left it; waits for one. @return nullptr: the reader
  /// wants no more.
  Batch* place() {
    std::unique_lock<std::mutex> lock(mutex_);
    writer_waits_.wait(lock, [&] { return stopped_ || written_ - read_ < batches_.size(); });
    return stopped_ ? nullptr : &batches_[written_ % batches_.size()];
  }
  /// Writer: what stands in place() is the reader's now.
  void hand_over() {
    change([&] { ++written_; }, reader_waits_);
  }
  /// Writer: nothing comes any more. @param error why, where it is not the end: the reader gets it behind the
  /// last batch.
  void close(std::exception_ptr error = nullptr) {
    change([&] { closed_ = true, error_ = std::move(error); }, reader_waits_);
  }

  /// Reader: the oldest batch that was not given back; waits for one. @return nullptr: that was all. @throws
  /// what the writer closed with.
  Batch* front() {
    std::unique_lock<std::mutex> lock(mutex_);
    reader_waits_.wait(lock, [&] { return closed_ || read_ < written_; });
    if (read_ < written_) return &batches_[read_ % batches_.size()];
    if (error_) std::rethrow_exception(error_);
    return nullptr;
  }
  /// Reader: front() may be written again.
  void give_back() {
    change([&] { ++read_; }, writer_waits_);
  }
  /// Reader: wants no more, so that a writer that waits goes on.
  void stop() {
    change([&] { stopped_ = true; }, writer_waits_);
  }

 private:
  template <class Change>
  void change(Change&& how, std::condition_variable& who_waits) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      how();
    }
    who_waits.notify_one();
  }

  std::vector<Batch> batches_;
  std::mutex mutex_;
  std::condition_variable writer_waits_;
  std::condition_variable reader_waits_;
  std::uint64_t written_ = 0;  ///< batches that were handed over
  std::uint64_t read_ = 0;     ///< batches that were given back
  bool closed_ = false;
  bool stopped_ = false;
  std::exception_ptr error_;
};

}  // namespace sprung
