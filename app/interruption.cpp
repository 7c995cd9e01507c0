// SPDX-License-Identifier: MIT
#include "app/interruption.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <mutex>
#include <thread>

#include "app/exit_codes.h"

namespace elbowroom {

struct Interruption::State {
  std::mutex mutex;
  bool settled = false;
  int seen = 0;
  std::stop_source stop;
};

// A thread of its own waits for the signal, since almost nothing may be done in a handler.
Interruption::Interruption(int patience) : state_(std::make_shared<State>()) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals, patience, state = state_] {
    for (;;) {
      int signal = 0;
      if (sigwait(&signals, &signal) != 0) return;
      // Held while the program ends, too: nothing begins to be written meanwhile.
      const std::lock_guard lock(state->mutex);
      if (state->settled) continue;
      if (++state->seen >= patience) _exit(kExitInterrupted);
      state->stop.request_stop();
    }
  }).detach();
}

std::stop_token Interruption::token() const { return state_->stop.get_token(); }

bool Interruption::settle() {
  const std::lock_guard lock(state_->mutex);
  state_->settled = true;
  return state_->seen == 0;
}

}  // namespace elbowroom
