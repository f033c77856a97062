#include "protocol/audit/trail_file.hpp"

#include <charconv>

#include "protocol/audit/escape.hpp"

namespace dripline::audit {
namespace {

constexpr std::string_view kTitle = "dripline audit 1", kEntry = "entry\t",
                           kCheckpoint = "checkpoint\t", kEnd = "end\t";

Result<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (ec == std::errc{} && end == text.data() + text.size() && fmt::format("{}", number) == text)
    return number;
  return fail(Errc::Syntax, "'{}' is not a whole number", text);
}

Result<TrailHeader> parse_header(std::string_view line) {
  const auto fields = fields_of(line);
  if (fields.size() != 3 || fields[0] != kTitle)
    return fail(Errc::Syntax, "not an audit trail: it begins with '{}'", kTitle);
  auto database = unescaped(fields[1]);
  if (!database) return fail(Errc::Syntax, "the database's name is not escaped");
  const auto key = parse_public_key(fields[2]);
  if (!key) return fail(key.error());
  return TrailHeader{*std::move(database), *key};
}

/// Of the fields after the word.
Result<Checkpoint> parse_checkpoint(std::string_view rest) {
  const auto fields = fields_of(rest);
  if (fields.size() != 5)
    return fail(Errc::Syntax, "a checkpoint has 5 fields, got {}", fields.size());
  const auto number = number_in(fields[0]);
  if (!number) return fail(number.error());
  const auto entry = number_in(fields[1]);
  if (!entry) return fail(entry.error());
  const auto time = number_in(fields[2]);
  if (!time) return fail(time.error());
  const auto digest = parse_digest(fields[3]);
  if (!digest) return fail(digest.error());
  const auto signature = parse_signature(fields[4]);
  if (!signature) return fail(signature.error());
  return Checkpoint{.number = *number,
                    .entry = *entry,
                    .time = UtcTime(UtcTime::duration(static_cast<std::int64_t>(*time))),
                    .digest = *digest,
                    .signature = *signature};
}

}  // namespace

std::string header_line(const TrailHeader& header) {
  return fmt::format("{}\t{}\t{}\n", kTitle, escaped(header.database), header.key.hex());
}

std::string entry_line(const Entry& entry, const Digest& digest) {
  return fmt::format("{}{}\t{}\n", kEntry, digest.hex(), line_of(entry));
}

std::string checkpoint_line(const Checkpoint& checkpoint) {
  return fmt::format("{}{}\t{}\t{}\t{}\t{}\n", kCheckpoint, checkpoint.number, checkpoint.entry,
                     checkpoint.time.time_since_epoch().count(), checkpoint.digest.hex(),
                     checkpoint.signature.hex());
}

std::string end_line(std::uint64_t entries) {
  return fmt::format("{}{}\n", kEnd, entries);
}

Result<KeptCheckpoint> parse_kept_checkpoint(std::string_view text) {
  const auto first = text.find('\n');
  if (first == std::string_view::npos) return fail(Errc::Syntax, "a checkpoint has two lines");
  auto header = parse_header(text.substr(0, first));
  if (!header) return fail(header.error());
  std::string_view line = text.substr(first + 1);
  if (!line.starts_with(kCheckpoint) || line.find('\n') != line.size() - 1)
    return fail(Errc::Syntax, "line 2 is not that of a checkpoint");
  line.remove_suffix(1);
  const auto checkpoint = parse_checkpoint(line.substr(kCheckpoint.size()));
  if (!checkpoint) return fail(checkpoint.error());
  if (is_signed_by(header->key, checkpoint_text(*checkpoint, header->database),
                   checkpoint->signature)) {
    return KeptCheckpoint{*std::move(header), *checkpoint};
  }
  return fail(Errc::Corrupt, "checkpoint {} is not signed with the key beside it",
              checkpoint->number);
}

Result<void> TrailReader::take_header(std::string_view line) {
  auto header = parse_header(line);
  if (!header) return fail(header.error());
  if (kept_ && kept_->header != *header) {
    return fail(
        Errc::Corrupt,
        "it is the trail of database {} with the key {}, the kept checkpoint is of {} with {}",
        header->database, header->key.hex(), kept_->header.database, kept_->header.key.hex());
  }
  verifier_.emplace(header->database, header->key);
  header_ = *std::move(header);
  return {};
}

Result<void> TrailReader::take_record(std::string_view line) {
  if (line.starts_with(kEntry)) {
    constexpr std::size_t kHex = 2 * Digest::kSize;
    const auto fields = line.substr(kEntry.size());
    if (fields.size() <= kHex || fields[kHex] != '\t')
      return fail(Errc::Syntax, "an entry begins with its digest");
    const auto digest = parse_digest(fields.substr(0, kHex));
    if (!digest) return fail(digest.error());
    const auto entry = parse_entry(fields.substr(kHex + 1));
    if (!entry) return fail(entry.error());
    if (kept_ && entry->number == kept_->checkpoint.entry) at_kept_ = *digest;
    verifier_->take(*entry, *digest);
    if (on_entry) on_entry(*entry);
    return {};
  }
  if (line.starts_with(kCheckpoint)) {
    const auto checkpoint = parse_checkpoint(line.substr(kCheckpoint.size()));
    if (!checkpoint) return fail(checkpoint.error());
    verifier_->take(*checkpoint);
    return {};
  }
  if (!line.starts_with(kEnd)) return fail(Errc::Syntax, "neither an entry nor a checkpoint");
  const auto entries = number_in(line.substr(kEnd.size()));
  if (!entries) return fail(entries.error());
  has_ended_ = true;
  if (*entries == verifier_->entries()) return {};
  verifier_->report({verifier_->last() + 1, fmt::format("{} entries were written, {} are there",
                                                        *entries, verifier_->entries())});
  return {};
}

Result<void> TrailReader::take(std::string_view line) {
  ++line_;
  const auto taken = has_ended_ ? Result<void>(fail(Errc::Syntax, "something follows the end"))
                     : header_  ? take_record(line)
                                : take_header(line);
  if (taken) return {};
  return fail(taken.error().code, "line {}: {}", line_, taken.error().what);
}

Result<void> TrailReader::feed(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto end = bytes.find('\n');
    rest_ += bytes.substr(0, end);
    if (rest_.size() > kMaxLine) {
      return fail(Errc::LimitExceeded, "line {} is longer than {} bytes", line_ + 1, kMaxLine);
    }
    if (end == std::string_view::npos) return {};
    if (auto taken = take(rest_); !taken) return taken;
    rest_.clear();
    bytes.remove_prefix(end + 1);
  }
  return {};
}

Result<void> TrailReader::finish() {
  if (!has_ended_ || !rest_.empty()) {
    return fail(Errc::Corrupt, "the file was cut off after line {}", line_);
  }
  return kept_ ? check_kept(kept_->checkpoint, at_kept_) : Result<void>();
}

}  // namespace dripline::audit
