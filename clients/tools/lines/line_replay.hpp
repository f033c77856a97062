#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/discipline.hpp"

/// A recorded line played again: what the host sent goes to a simulated control, what the
/// control sent to a simulated host. Pure; one thread.
namespace dripline::wire {

/// One entry of a recording, made at the host's end.
struct RecordedTraffic {
  enum class What : std::uint8_t { Sent, Received, Fault, Lines, Note };
  LineTime time{};  ///< since the recording began
  What what = What::Note;
  std::string bytes;  ///< Sent, Received
};

struct ReplayReport {
  std::uint64_t sent = 0, received = 0, faults = 0;  ///< characters and faults of the recording
  struct Transfer {
    std::string name, text;
    bool has_ended = false;  ///< well
  };
  std::vector<Transfer> to_control;    ///< as the simulated control took them
  std::vector<Transfer> from_control;  ///< as the simulated host took them
  /// In order: time in seconds and what was noticed, a sentence each.
  std::vector<std::string> findings;
  std::uint64_t deviations = 0;  ///< answers that the simulated control gave otherwise
};

class LineReplay {
 public:
  /// Errors: those of make_discipline.
  static Result<LineReplay> make(const LineSettings& settings);

  /// The next entry; times do not go backwards.
  void play(const RecordedTraffic& entry);
  /// After the last one: waits in virtual time for what is still to come.
  ReplayReport finish();

  static constexpr std::size_t kMaxFindings = 1000;
  static constexpr std::size_t kMaxText = std::size_t{64} * 1024 * 1024;  ///< kept of all transfers

 private:
  struct End {
    std::unique_ptr<Discipline> line;
    std::vector<ReplayReport::Transfer>* transfers = nullptr;
    bool is_control = false;
    std::string name;  ///< of the transfer that was begun
  };
  LineReplay(const LineSettings& settings, std::unique_ptr<Discipline> host,
             std::unique_ptr<Discipline> control);

  void pass_time(LineTime now);
  void hear(End& end, const std::string& bytes);
  void begin_control(const RecordedTraffic& entry);
  void hold(char c);
  void ask_as_recorded(const std::string& bytes);
  void serve(End& end);
  void take(End& end, const Event& event);
  void compare();
  void say(std::string text);
  bool is_comparable(char c) const;

  LineSettings settings_;
  LineTime now_{};
  std::unique_ptr<ReplayReport> report_;
  End host_, control_;
  std::string recorded_, simulated_;  ///< answers of the control that wait to be compared
  std::size_t text_kept_ = 0;
};

}  // namespace dripline::wire
