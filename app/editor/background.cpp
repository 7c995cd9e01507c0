// SPDX-License-Identifier: MIT
#include "app/editor/background.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <exception>
#include <utility>

namespace elbowroom {
namespace {

// Who looks at the window goes before who computes, where both want the same core. On Linux
// niceness is a thread's own; elsewhere it is left as it is.
void yield_to_the_window() {
#ifdef __linux__
  constexpr int kNiceness = 10;
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
#endif
}

}  // namespace

void Mailbox::post(Letter letter) {
  {
    const std::lock_guard lock(mutex_);
    letters_.push_back(std::move(letter));
  }
  if (wake_) wake_();
}

std::vector<Mailbox::Letter> Mailbox::collect() {
  const std::lock_guard lock(mutex_);
  return std::exchange(letters_, {});
}

BackgroundThread::BackgroundThread(std::function<void(std::string)> failed)
    : failed_(std::move(failed)), thread_([this](const std::stop_token& end) { work(end); }) {}

BackgroundThread::~BackgroundThread() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
    running_.request_stop();
  }
  thread_.request_stop();
}

std::stop_source BackgroundThread::run(Job job) {
  Entry entry{std::move(job), {}};
  std::stop_source stop = entry.stop;
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(entry));
  }
  changed_.notify_one();
  return stop;
}

void BackgroundThread::work(const std::stop_token& end) {
  yield_to_the_window();
  while (true) {
    Entry entry;
    {
      std::unique_lock lock(mutex_);
      if (!changed_.wait(lock, end, [this] { return !waiting_.empty(); })) return;
      entry = std::move(waiting_.front());
      waiting_.pop_front();
      running_ = entry.stop;
    }
    try {
      entry.job(entry.stop.get_token());
    } catch (const std::exception& problem) {
      if (failed_) failed_(problem.what());
    }
  }
}

}  // namespace elbowroom
