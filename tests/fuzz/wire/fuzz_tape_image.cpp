// A tape image in any code. Properties: however it is cut it reads the same; what was read can be
// punched in ISO and reads back the same; a listing has a line for what is on the tape.
#include <algorithm>
#include <cstdlib>

#include "clients/tools/lines/tape_listing.hpp"
#include "protocol/wire/tape_image.hpp"

namespace {

using namespace dripline::wire;

std::string read(const TapeReading& reading, std::span<const std::byte> rows, std::size_t piece) {
  TapeReader reader(reading);
  std::string text;
  for (; !rows.empty(); rows = rows.subspan(std::min(piece, rows.size()))) {
    const auto done = reader.read(rows.first(std::min(piece, rows.size())), text);
    if (!done) return text + "|" + done.error().what;
  }
  const auto done = reader.finish(text);
  return done ? text : text + "|" + done.error().what;
}

std::string list(CharacterCode code, std::span<const std::byte> rows, std::size_t piece) {
  TapeListing listing(code);
  std::string text;
  for (; !rows.empty(); rows = rows.subspan(std::min(piece, rows.size()))) {
    listing.list(rows.first(std::min(piece, rows.size())), text);
  }
  listing.finish(text);
  return text;
}

void punch_and_read(const std::string& text) {
  TapeForm form;
  form.has_rewind_stop = false;
  TapePunch punch(form);
  std::vector<std::byte> rows;
  if (!punch.begin(rows) || !punch.punch(text, rows)) std::abort();
  punch.finish(rows);
  if (read({CharacterCode::Iso, false}, rows, 1) != text) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto rows = std::as_bytes(std::span(data + 1, size - 1));
  const auto code = static_cast<CharacterCode>(data[0] % 3);
  const std::size_t piece = data[0] / 16 + 2;
  const TapeReading reading{code, (data[0] & 4) != 0, (data[0] & 8) != 0};
  const auto text = read(reading, rows, rows.size() + 1);
  if (text != read(reading, rows, piece)) std::abort();
  if (list(code, rows, rows.size() + 1) != list(code, rows, piece)) std::abort();
  if (reading.replaces_wrong_rows && text.find('|') == text.npos) punch_and_read(text);
  return 0;
}
