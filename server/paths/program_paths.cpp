#include "server/paths/program_paths.hpp"

#include <array>

#include <nlohmann/json.hpp>

#include "clients/tools/offline/check_summary.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/registry.hpp"
#include "server/machines/stored_programs.hpp"
#include "server/paths/impl/interpretation.hpp"
#include "server/paths/path_encoder.hpp"

namespace dripline::paths {
namespace {

using nlohmann::json;

/// Of one piece: what comes first ends it, so that a client that leaves is noticed soon.
constexpr std::size_t kPieceBytes = 256 * 1024;
constexpr std::uint64_t kPieceBlocks = 65'536;

enum class Frame : char { Json = 'J', Points = 'P' };

void append_frame(std::string& piece, Frame kind, std::string_view content) {
  piece += static_cast<char>(kind);
  for (unsigned shift = 0; shift < 32; shift += 8)
    piece += static_cast<char>(content.size() >> shift & 0xff);
  piece += content;
}

void append_frame(std::string& piece, const json& value) {
  append_frame(piece, Frame::Json,
               value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

class Reader final : public PathReader {
 public:
  struct Parts {
    machines::RunSources sources;
    storage::Run run;  ///< that the program would be, for the programs it calls
    interpreter::Setup setup;
    const interpreter::Dialect& dialect;
    double tolerance = 0;
  };
  Reader(Seat seat, Parts parts)
      : seat_(std::move(seat)),
        parts_(std::move(parts)),
        source_(parts_.sources, parts_.run),
        encoder_(parts_.setup.start, parts_.tolerance),
        summary_(parts_.setup.start) {}

  Result<void> begin() {
    auto run =
        interpreter::OfflineRun::begin(parts_.dialect, parts_.setup, source_, both_, kLimits);
    if (!run) return fail(run.error());
    run_.emplace(*std::move(run));
    return {};
  }

  Result<std::optional<std::string>> next() override {
    if (is_over_) return std::optional<std::string>();
    std::string piece;
    if (!has_begun_) append_frame(piece, begin_json());
    has_begun_ = true;
    for (std::uint64_t blocks = 0; blocks < kPieceBlocks; blocks += kStepBlocks) {
      append_step(piece);
      if (is_over_ || piece.size() >= kPieceBytes) break;
    }
    return std::optional(std::move(piece));
  }

 private:
  void step() {
    const auto is_over = run_->step(kStepBlocks);
    if (!is_over) fault_ = is_over.error().what;
    is_over_ = !is_over || *is_over;
  }

  /// The blocks of each step are stated, so that a reader finds the point of a block that a machine
  /// executes, also in a loop.
  void append_step(std::string& piece) {
    step();
    if (is_over_) encoder_.finish();
    if (encoder_.size() > 0) append_frame(piece, Frame::Points, encoder_.take());
    append_frame(piece, is_over_ ? end_json() : progress_json());
  }

  json begin_json() const {
    return {{"kind", "begin"},
            {"program", parts_.run.program},
            {"revision", parts_.run.revision},
            {"control", parts_.run.control},
            {"size", parts_.run.size},
            {"lathe", parts_.dialect.machine == interpreter::MachineKind::Lathe}};
  }
  json progress_json() const {
    const auto& summary = summary_.summary();
    return {{"kind", "progress"}, {"blocks", summary.blocks}, {"points", encoder_.points()}};
  }
  json end_json() const;
  json fault_json() const;

  Seat seat_;
  Parts parts_;
  machines::StoredPrograms source_;
  PathEncoder encoder_;
  interpreter::CheckSummary summary_;
  interpreter::EventTee both_{encoder_, summary_};
  std::optional<interpreter::OfflineRun> run_;
  std::string fault_;  ///< why it was stopped that is no alarm of the control
  bool has_begun_ = false;
  bool is_over_ = false;
};

json Reader::fault_json() const {
  if (const auto& alarm = summary_.summary().alarm) {
    return {{"id", std::string(alarm->diagnostic.id)},
            {"text", alarm->diagnostic.text},
            {"line", alarm->diagnostic.line}};
  }
  return fault_.empty() ? json(nullptr) : json{{"id", ""}, {"text", fault_}, {"line", 0}};
}

json Reader::end_json() const {
  const auto& summary = summary_.summary();
  auto tools = json::array();
  for (const PathTool& tool : encoder_.tools())
    tools.push_back({{"number", tool.number}, {"line", tool.line}, {"point", tool.point}});
  return {{"kind", "end"},
          {"blocks", summary.blocks},
          {"points", encoder_.points()},
          {"seconds", summary.seconds},
          {"rapid_mm", summary.rapid_length.mm()},
          {"feed_mm", summary.feed_length.mm()},
          {"inch", summary.units == interpreter::Units::Inch},
          {"x_is_diameter", summary.x_is_diameter},
          {"extents", extents_json(summary)},
          {"tools", std::move(tools)},
          {"warnings", summary.warning_count},
          {"other_axes", encoder_.other_axes()},
          {"ended", summary.ended},
          {"fault", fault_json()}};
}

}  // namespace

Result<std::unique_ptr<PathReader>> ProgramPaths::open(const PathRequest& request) {
  const auto& revision = request.revision;
  const auto dialect = interpreter::find_dialect(revision.control);
  if (!dialect) return fail(Errc::Unsupported, "{}", dialect.error().what);
  auto setup = interpretation_setup(sources_, request.machine, **dialect);
  if (!setup) return fail(setup.error());
  auto seat = Seat::take(readers_, kMaxReaders);
  if (!seat) {
    return fail(Errc::Busy, "{} tool paths are being computed: the limit; try again", kMaxReaders);
  }
  auto reader = std::make_unique<Reader>(
      *std::move(seat), Reader::Parts{.sources = sources_,
                                      .run = interpreted_run(sources_, revision, request.machine),
                                      .setup = *std::move(setup),
                                      .dialect = **dialect,
                                      .tolerance = request.tolerance});
  if (auto begun = reader->begin(); !begun) return fail(begun.error());
  return std::unique_ptr<PathReader>(std::move(reader));
}

}  // namespace dripline::paths
