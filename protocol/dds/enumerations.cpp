#include "protocol/dds/enumerations.hpp"

#include <array>

namespace dripline::dds {

using Words = std::span<const std::string_view>;

Words words_of(Execution) {
  static constexpr std::array<std::string_view, 9> kWords{
      "READY",   "ACTIVE",          "INTERRUPTED",       "FEED_HOLD",
      "STOPPED", "PROGRAM_STOPPED", "PROGRAM_COMPLETED", "OPTIONAL_STOP",
      "WAIT"};
  return kWords;
}

Words words_of(ControllerMode) {
  static constexpr std::array<std::string_view, 3> kWords{"AUTOMATIC", "MANUAL_DATA_INPUT",
                                                          "MANUAL"};
  return kWords;
}

Words words_of(RecordKind) {
  static constexpr std::array<std::string_view, 10> kWords{
      "run_started", "run_ended", "output", "probe",         "message",
      "stop",        "warning",   "alarm",  "device_opened", "device_closed"};
  return kWords;
}

Words words_of(CommandAction) {
  static constexpr std::array<std::string_view, 15> kWords{
      "start",         "hold",           "resume",
      "abort",         "answer",         "switch",
      "feed_override", "rapid_override", "spindle_override",
      "handwheel",     "refuse",         "query",
      "set_position",  "playback",       "jog"};
  return kWords;
}

Words words_of(BlockStatus) {
  static constexpr std::array<std::string_view, 6> kWords{
      "ok", "no_such_run", "no_such_program", "out_of_range", "corrupt", "failed"};
  return kWords;
}

Words words_of(MotionKind) {
  static constexpr std::array<std::string_view, 6> kWords{
      "none", "rapid", "line", "clockwise", "counterclockwise", "thread"};
  return kWords;
}

Words words_of(CompensationSide) {
  static constexpr std::array<std::string_view, 3> kWords{"off", "left", "right"};
  return kWords;
}

Words words_of(FeedUnit) {
  static constexpr std::array<std::string_view, 3> kWords{"per_minute", "per_revolution",
                                                          "inverse_time"};
  return kWords;
}

Words words_of(SpindleState) {
  static constexpr std::array<std::string_view, 5> kWords{"unknown", "off", "clockwise",
                                                          "counterclockwise", "oriented"};
  return kWords;
}

Words words_of(PositionDisplay) {
  static constexpr std::array<std::string_view, 6> kWords{
      "unknown", "actual", "reference", "following_error", "nominal", "distance_to_go"};
  return kWords;
}

Words words_of(RemoteEnable) {
  static constexpr std::array<std::string_view, 4> kWords{"unknown", "unattended", "given",
                                                          "not_given"};
  return kWords;
}

Words words_of(WaitsFor) {
  static constexpr std::array<std::string_view, 6> kWords{"unknown", "nothing", "cycle_start",
                                                          "text",    "answer",  "disk"};
  return kWords;
}

Words words_of(SwitchState) {
  static constexpr std::array<std::string_view, 3> kWords{"unknown", "off", "on"};
  return kWords;
}

Words words_of(LinePhase) {
  static constexpr std::array<std::string_view, 4> kWords{"idle", "sending", "receiving",
                                                          "requesting"};
  return kWords;
}

Words words_of(LineCallAction) {
  static constexpr std::array<std::string_view, 6> kWords{"send",    "directory", "restart",
                                                          "program", "list",      "next_job"};
  return kWords;
}

Words words_of(LineAction) {
  static constexpr std::array<std::string_view, 12> kWords{
      "recording", "upload",  "stored", "answer", "refuse", "done",
      "test",      "receive", "text",   "send",   "stop",   "judge"};
  return kWords;
}

Words words_of(LineTransferState) {
  static constexpr std::array<std::string_view, 4> kWords{"sending", "completed", "aborted",
                                                          "interrupted"};
  return kWords;
}

Words words_of(LineResult) {
  static constexpr std::array<std::string_view, 3> kWords{"done", "refused", "not_yet"};
  return kWords;
}

}  // namespace dripline::dds
