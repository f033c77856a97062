#include "protocol/audit/chain.hpp"

#include <array>
#include <charconv>
#include <optional>

#include "protocol/audit/escape.hpp"

namespace dripline::audit {
namespace {

constexpr std::size_t kEntryFields = 8;

/// As fmt writes it: no sign of plus, no leading zero.
template <class Number>
bool read_number(std::string_view text, Number& number) {
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), number);
  return ec == std::errc{} && end == text.data() + text.size() && fmt::format("{}", number) == text;
}

}  // namespace

std::string line_of(const Entry& entry) {
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}", entry.number,
                     entry.time.time_since_epoch().count(), escaped(entry.who),
                     escaped(entry.credential), escaped(entry.address), escaped(entry.action),
                     escaped(entry.subject), escaped(entry.detail));
}

Result<Entry> parse_entry(std::string_view line) {
  const auto fields = fields_of(line);
  if (fields.size() != kEntryFields)
    return fail(Errc::Syntax, "an entry has {} fields, got {}", kEntryFields, fields.size());
  Entry entry;
  std::int64_t time = 0;
  if (!read_number(fields[0], entry.number) || !read_number(fields[1], time))
    return fail(Errc::Syntax, "number and time of an entry are whole numbers");
  entry.time = UtcTime(UtcTime::duration(time));
  const std::array texts{&entry.who,    &entry.credential, &entry.address,
                         &entry.action, &entry.subject,    &entry.detail};
  for (std::size_t i = 0; i < texts.size(); ++i) {
    auto text = unescaped(fields[i + 2]);
    if (!text) return fail(Errc::Syntax, "entry {}: field {} is not escaped", entry.number, i + 3);
    *texts.at(i) = *std::move(text);
  }
  return entry;
}

Digest chain_begin(std::string_view database) {
  return sha256(fmt::format("dripline audit 1\n{}\n", database));
}

Digest chain_next(const Digest& before, std::string_view line) {
  return sha256(fmt::format("{}\n{}\n", before.hex(), line));
}

std::string checkpoint_text(const Checkpoint& checkpoint, std::string_view database) {
  return fmt::format(
      "dripline audit checkpoint 1\ndatabase {}\nnumber {}\nentry {}\ntime {}\nsha256 {}\n",
      database, checkpoint.number, checkpoint.entry, checkpoint.time.time_since_epoch().count(),
      checkpoint.digest.hex());
}

}  // namespace dripline::audit
