#include "server/ports/programs/start_finder.hpp"

#include <functional>

#include "gateway/line/heads/head_scan.hpp"

namespace dripline::ports {
namespace {

constexpr std::uint64_t kPiece = 256 * 1024;

/// Hands out the program's text, until `take` returns true or it is over.
Result<void> read_program(storage::ProgramStore& store, const storage::Run& run,
                          const std::function<bool(std::string_view)>& take) {
  for (std::uint64_t offset = 0; offset < run.size;) {
    const auto bytes = store.read_content(run.content, offset, kPiece);
    if (!bytes) return fail(bytes.error());
    if (bytes->empty()) return fail(Errc::Corrupt, "content {} is short", run.content.hex());
    if (take({reinterpret_cast<const char*>(bytes->data()), bytes->size()})) return {};
    offset += bytes->size();
  }
  return {};
}

line::HeadChoice to_choice(machines::StartHead choice) {
  if (choice == machines::StartHead::Send) return line::HeadChoice::Send;
  return choice == machines::StartHead::Set ? line::HeadChoice::Set : line::HeadChoice::Ask;
}

}  // namespace

Result<line::ProgramPlace> find_start(storage::ProgramStore& store, const storage::Run& run,
                                      const machines::StartPoint& from) {
  if (from.skipped) {
    return fail(Errc::Unsupported,
                "over a serial line a run begins at a block, a line, a byte or a tool");
  }
  const line::WantedPlace wanted{from.byte, from.line, from.sequence, from.tool};
  if (wanted.is_beginning()) return line::ProgramPlace{};
  line::PlaceFinder finder(wanted, run.control);
  bool is_found = false;
  const auto read = read_program(
      store, run, [&](std::string_view piece) { return is_found = finder.look(piece); });
  if (!read) return fail(read.error());
  if (is_found || finder.look_at_end()) return finder.place();
  return fail(Errc::NotFound, "program '{}' has no {}; it has {} bytes", run.program,
              line::to_text(wanted), run.size);
}

Result<std::string> start_head(storage::ProgramStore& store, const storage::Run& run,
                               const line::ProgramPlace& place, machines::StartHead choice) {
  if (place.byte == 0 || choice == machines::StartHead::Set) return std::string();
  line::HeadScan scan(run.control, place);
  const auto read =
      read_program(store, run, [&scan](std::string_view piece) { return !scan.take(piece); });
  if (!read) return fail(read.error());
  scan.end();
  return scan.head(to_choice(choice));
}

}  // namespace dripline::ports
