#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/line/line_session.hpp"
#include "gateway/line/port_view.hpp"

/// What a line does, for people: the same words on a port of the server and on a gateway.
namespace dripline::line {

enum class LineActivity : std::uint8_t { Ready, Waiting, Held, Active };
LineActivity activity_of(const LineView& port, const std::optional<SendProgress>& progress);
/// What it waits for, or why it does nothing; empty: there is no text.
std::string message_of(const LineView& port, const std::optional<SendProgress>& progress);

/// The place an operator needs to continue from; `done`: what is known of it, "sent" or "accepted".
std::string place_words(std::uint64_t line, std::int64_t sequence, std::string_view done);
/// How a run over a line ends well.
inline constexpr std::string_view kSentToItsEnd =
    "sent to its end; a line does not report what was executed";
/// What a control asked for in vain, for people.
std::string request_words(const PortRequest& request);
/// In the reason of a run that ended in front of its program's first character.
inline constexpr std::string_view kHeadLeft = "a part of what is sent before the program has left";
/// Of a busy port: "receiving", "sending run ..." or which programs it sends.
std::string what_it_does(const LineView& port);
/// What a job sends: the programs of a transfer; an answer is one of comments, or has no name.
std::vector<std::string> programs_of(const SendJob& job);
/// A part of it has left, and not all.
bool is_cut_off(const SendEnd& end);

}  // namespace dripline::line
