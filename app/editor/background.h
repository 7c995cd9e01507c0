// SPDX-License-Identifier: MIT
// Work beside the window: a thread that does one job after another, and the mailbox through which
// results come back to the window's own thread.
//
// Jobs own what they compute with; they reach the editor only by letters, functions that the
// window's thread runs when it collects them. So nothing of the editor needs a lock.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace elbowroom {

class Mailbox {
 public:
  using Letter = std::function<void()>;

  // `wake` is called on the posting thread after each letter: it gets the window out of waiting.
  explicit Mailbox(std::function<void()> wake = {}) : wake_(std::move(wake)) {}

  void post(Letter letter);       // any thread
  std::vector<Letter> collect();  // the window's thread; in the order of posting

 private:
  std::mutex mutex_;
  std::vector<Letter> letters_;
  std::function<void()> wake_;
};

class BackgroundThread {
 public:
  using Job = std::function<void(std::stop_token)>;

  // `failed` is told, on this thread, of a job that ended by an exception (memory that has run
  // out).
  explicit BackgroundThread(std::function<void(std::string)> failed = {});
  // Asks the running job to stop, forgets the others, and waits.
  ~BackgroundThread();
  BackgroundThread(const BackgroundThread&) = delete;
  BackgroundThread& operator=(const BackgroundThread&) = delete;

  // Runs the job after those that wait. The source stops this job alone: when it is asked to
  // before the job has begun, the job still runs and sees the stop at once.
  std::stop_source run(Job job);

 private:
  struct Entry {
    Job job;
    std::stop_source stop;
  };
  void work(const std::stop_token& end);

  std::function<void(std::string)> failed_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Entry> waiting_;
  std::stop_source running_;
  std::jthread thread_;  // last: it uses what stands above
};

}  // namespace elbowroom
