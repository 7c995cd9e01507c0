// SPDX-License-Identifier: MIT
// SIGINT: whether a run is interrupted is decided in one place, once.
//
// Until settle() a SIGINT is a stop request, which commands answer soon; further ones end the
// program at once. From settle() on what is left is short and must not end halfway (files that are
// written, a report), and a SIGINT changes nothing any more. So a run either leaves nothing but a
// report and ends with 130, or all its files and its own exit code.
#pragma once

#include <memory>
#include <stop_token>

namespace elbowroom {

class Interruption {
 public:
  // From here on this process takes SIGINT so. `patience`: the how many-th one before settle() ends
  // the program at once; 1 for a command that looks at no stop token. One object in a process, made
  // before other threads are.
  explicit Interruption(int patience = 2);

  std::stop_token token() const;
  // Call before anything is written. False if a SIGINT came before the first call, from any thread.
  bool settle();

 private:
  struct State;
  std::shared_ptr<State> state_;  // shared with the thread that waits for the signal
};

}  // namespace elbowroom
