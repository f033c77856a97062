#include "protocol/dds/message.hpp"

namespace dripline::dds {

std::string_view to_string(Execution value) {
  static constexpr std::array<std::string_view, 9> kNames{
      "READY",   "ACTIVE",          "INTERRUPTED",       "FEED_HOLD",
      "STOPPED", "PROGRAM_STOPPED", "PROGRAM_COMPLETED", "OPTIONAL_STOP",
      "WAIT"};
  return kNames.at(static_cast<std::size_t>(value));
}

std::string_view to_string(ControllerMode value) {
  static constexpr std::array<std::string_view, 3> kNames{"AUTOMATIC", "MANUAL_DATA_INPUT",
                                                          "MANUAL"};
  return kNames.at(static_cast<std::size_t>(value));
}

std::string_view to_string(RecordKind value) {
  static constexpr std::array<std::string_view, 10> kNames{
      "run_started", "run_ended", "output", "probe",         "message",
      "stop",        "warning",   "alarm",  "device_opened", "device_closed"};
  return kNames.at(static_cast<std::size_t>(value));
}

std::string_view to_string(CommandAction value) {
  static constexpr std::array<std::string_view, 11> kNames{
      "start",         "hold",           "resume",           "abort",     "answer", "switch",
      "feed_override", "rapid_override", "spindle_override", "handwheel", "refuse"};
  return kNames.at(static_cast<std::size_t>(value));
}

std::string_view to_string(BlockStatus value) {
  static constexpr std::array<std::string_view, 6> kNames{
      "ok", "no_such_run", "no_such_program", "out_of_range", "corrupt", "failed"};
  return kNames.at(static_cast<std::size_t>(value));
}

std::string_view to_string(MotionKind value) {
  static constexpr std::array<std::string_view, 6> kNames{
      "none", "rapid", "line", "clockwise", "counterclockwise", "thread"};
  return kNames.at(static_cast<std::size_t>(value));
}

std::string_view to_string(CompensationSide value) {
  static constexpr std::array<std::string_view, 3> kNames{"off", "left", "right"};
  return kNames.at(static_cast<std::size_t>(value));
}

std::string_view to_string(SpindleState value) {
  static constexpr std::array<std::string_view, 5> kNames{"not_told", "off", "clockwise",
                                                          "counterclockwise", "oriented"};
  return kNames.at(static_cast<std::size_t>(value));
}

std::string_view to_string(RemoteEnable value) {
  static constexpr std::array<std::string_view, 4> kNames{"not_told", "unattended", "given",
                                                          "not_given"};
  return kNames.at(static_cast<std::size_t>(value));
}

std::string_view to_string(WaitsFor value) {
  static constexpr std::array<std::string_view, 6> kNames{"not_told", "nothing", "cycle_start",
                                                          "text",     "answer",  "disk"};
  return kNames.at(static_cast<std::size_t>(value));
}

std::string_view to_string(FeedUnit value) {
  static constexpr std::array<std::string_view, 3> kNames{"per_minute", "per_revolution",
                                                          "inverse_time"};
  return kNames.at(static_cast<std::size_t>(value));
}

}  // namespace dripline::dds
