#include "tessera/simulation/signals.hpp"

#include <csignal>

namespace tessera {

namespace {

volatile std::sig_atomic_t received_signal = 0;
constexpr int watched[3] = {SIGINT, SIGTERM, SIGUSR1};

void note(int signal) { received_signal = signal; }

}  // namespace

StopSignals::StopSignals() {
  received_signal = 0;
  for (int i = 0; i < 3; ++i) previous_[i] = std::signal(watched[i], note);
}

StopSignals::~StopSignals() {
  for (int i = 0; i < 3; ++i) std::signal(watched[i], previous_[i]);
}

int StopSignals::received() { return received_signal; }

}  // namespace tessera
