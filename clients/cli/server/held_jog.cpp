#include "clients/cli/server/held_jog.hpp"

#include <fmt/core.h>
#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/key_repeats.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "protocol/base/random.hpp"

namespace dripline::cli {
namespace {

using namespace std::chrono_literals;
using Heard = KeyRepeats::Heard;

/// A terminal waits up to 660 ms before its first repeat; the gateway's limit is shorter.
constexpr auto kFirstRepeat = 1000ms;
/// Without a key for so long it is released.
constexpr auto kReleased = 250ms;
constexpr auto kBetween = 80ms;  ///< keeps; a terminal repeats some 30 times a second
constexpr auto kLook = 50ms;     ///< whether the jog has ended

/// Two keys within the time of a repeat: one is held down.
bool is_held_down(KeyRepeats& keys) {
  for (;;) {
    const Heard first = keys.wait(kFirstRepeat);
    if (first == Heard::End) return false;
    if (first == Heard::Nothing) continue;
    const Heard second = keys.wait(kFirstRepeat);
    if (second != Heard::Nothing) return second == Heard::Key;
  }
}

/// Until no key comes any more, or the jog is over. A refusal needs nothing: the jog's own answer
/// states why it has ended.
void keep_moving(KeyRepeats& keys, client::Client& keeper, const std::string& machine,
                 const std::string& word, const std::atomic<bool>& is_over) {
  using Clock = std::chrono::steady_clock;
  auto heard = Clock::now(), kept = heard - kBetween;
  while (!is_over) {
    const Heard key = keys.wait(kLook);
    const auto now = Clock::now();
    if (key == Heard::End || (key == Heard::Nothing && now - heard > kReleased)) return;
    if (key == Heard::Nothing) continue;
    heard = now;
    if (now - kept < kBetween) continue;
    kept = now;
    (void)keeper.keep_jog(machine, word);
  }
}

}  // namespace

int hold_jog(Context& context, client::Client& client, const std::string& machine,
             const client::JogToMake& jog) {
  auto keeper = context.connect();
  if (!keeper) return context.status;
  print_error("dnc: hold a key down: {} moves while it repeats; Ctrl-C ends\n", jog.axis);
  KeyRepeats keys;
  if (!is_held_down(keys)) {
    print_error("dnc: no key was held down; nothing has moved\n");
    return kExitNo;
  }
  client::JogToMake held = jog;
  held.hold = fmt::format("{:x}", random_number());
  std::atomic<bool> is_over = false;
  std::optional<client::Reply<client::JogDone>> answer;
  std::thread mover([&] {
    answer = client.jog(machine, held);
    is_over = true;
  });
  keep_moving(keys, *keeper, machine, held.hold, is_over);
  // It stops by itself too; this is sooner.
  if (!is_over)
    (void)keeper->command_machine(machine,
                                  {.action = "stop_jog", .text = {}, .name = {}, .value = {}});
  mover.join();
  const auto& done = *answer;
  if (!done) return complain(done.error());
  context.print(context.wants_json ? json_text(*done)
                                   : fmt::format("{}: {}\n", machine, done->text));
  return kExitOk;
}

}  // namespace dripline::cli
