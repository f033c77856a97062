#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/post/adaptation.hpp"
#include "clients/tools/post/carried_comments.hpp"
#include "clients/tools/post/program_writer.hpp"

namespace dripline::post {

/// What was written.
struct WrittenCounts {
  std::uint64_t blocks = 0, moves = 0, arcs = 0, actions = 0;  ///< actions: other than moves
  std::uint64_t comments = 0, comments_left_out = 0;
};

/// Writes adapted events as a program of the grid's target: absolute coordinates, each word only
/// where its value changes. Memory does not grow with the program. One thread.
class PostProcessor final : public interpreter::EventSink {
 public:
  using Output = std::function<Result<void>(std::string_view)>;

  struct Parts {
    const Grid& grid;
    ProgramWriter& writer;
    ProgramHead head;
    interpreter::Position start;  ///< of the source
    double tolerance = 0.001;     ///< as in AdaptationOptions
    CarriedComments comments;
    Output output;
    const KeptCompensation* compensation = nullptr;  ///< absent: none is written
  };
  explicit PostProcessor(Parts parts);

  /// Writes what is still in memory. Errors: those of the output.
  Result<void> finish();
  /// What the writer refused, or the output's error.
  const std::optional<Refusal>& refusal() const { return refusal_; }
  const std::optional<Error>& error() const { return error_; }
  bool has_ended() const { return has_ended_; }
  WrittenCounts counts() const;
  /// Called, by their numbers.
  const std::set<int>& tools() const { return tools_; }

  void on_rapid(const interpreter::Rapid& event) override;
  void on_line(const interpreter::Line& event) override;
  void on_arc(const interpreter::Arc& event) override;
  void on_thread(const interpreter::Thread& event) override;
  void on_dwell(const interpreter::Dwell& event) override;
  void on_spindle(const interpreter::Spindle& event) override;
  void on_coolant(const interpreter::Coolant& event) override;
  void on_tool(const interpreter::ToolChange& event) override;
  void on_miscellaneous(const interpreter::Miscellaneous& event) override;
  void on_message(const interpreter::Message& event) override;
  void on_stop(const interpreter::Stop& event) override;
  void on_end(const interpreter::End& event) override;

 private:
  /// A state of spindle or coolant that is not written before the next event: the end of the
  /// program may switch it off itself.
  struct PendingState {
    std::optional<interpreter::Spindle> spindle;
    std::optional<interpreter::Coolant> coolant;
  };

  bool begin(const interpreter::Origin& origin);
  void write_comments(const interpreter::Origin& origin);
  void write_comment(std::string_view text);
  void write_pending();
  void write_spindle(const interpreter::Spindle& spindle);
  void write_coolant(const interpreter::Coolant& coolant);
  void flush_if_large();
  void check(const interpreter::Origin& origin, const Result<void>& written);
  void check_size(const interpreter::Origin& origin);
  void name_axes(const interpreter::Origin& origin, const interpreter::Position& to,
                 MoveWords& move);
  bool check_axes(const interpreter::Origin& origin, const MoveWords& move);
  bool name_feed(const interpreter::Origin& origin, Feed feed, MoveWords& move);
  bool has_speed() const;
  void arrive(const interpreter::Position& to, const MoveWords& move);

  Parts parts_;
  std::string text_;
  interpreter::Position at_;
  std::array<std::int64_t, interpreter::kAxisCount> counts_{};  ///< where the target is
  std::bitset<interpreter::kAxisCount> known_;  ///< axes whose place a word has given
  std::optional<FeedWord> feed_;
  std::optional<interpreter::Spindle> spindle_;  ///< written last
  std::optional<interpreter::Coolant> coolant_;
  std::vector<PendingState> pending_;
  std::vector<std::string> new_comments_;
  WrittenCounts written_;
  std::set<int> tools_;
  std::optional<Refusal> refusal_;
  std::optional<Error> error_;
  bool has_ended_ = false;
};

}  // namespace dripline::post
