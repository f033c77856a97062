#include "clients/cli/measurements/archive_source.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "clients/cli/measurements/measurement_input.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/tools/measurement_files/text_files.hpp"

namespace dripline::cli {
namespace {

using measurement_files::Visitor;
using nlohmann::ordered_json;

class ArchiveSource final : public measurement_files::MeasurementSource {
 public:
  ArchiveSource(archive::VerifiedArchive archive, std::string name, bool with_superseded)
      : archive_(std::move(archive)), name_(std::move(name)), with_superseded_(with_superseded) {}

  Result<void> each(const Visitor& visit) override {
    bool is_superseded = false;
    std::uint64_t number = 0;
    return archive_.each([&](const std::string& text) -> Result<void> {
      ++number;
      const auto row = ordered_json::parse(text, nullptr, false);
      if (!row.is_object())
        return fail(Errc::Corrupt, "archive {}: row {} is no JSON", name_, number);
      // A part goes before its measurements.
      if (const auto part = row.find("part"); part != row.end()) {
        const auto flag = part->is_object() ? part->find("superseded") : part->end();
        is_superseded = part->is_object() && flag != part->end() && *flag == true;
      }
      const auto found = row.find("measurement");
      if (found == row.end() || (is_superseded && !with_superseded_)) return {};
      const auto one = measurement_files::read_json_line(found->dump());
      if (!one) {
        return fail(one.error().code, "archive {}: row {}: {}", name_, number, one.error().what);
      }
      return visit(*one);
    });
  }

 private:
  archive::VerifiedArchive archive_;
  std::string name_;
  bool with_superseded_;
};

Result<void> check_digest(const ArchiveChoice& choice, const archive::VerifiedArchive& archive) {
  if (choice.sha256.empty()) return {};
  constexpr std::size_t kLeast = 8;
  std::string wanted = choice.sha256;
  std::ranges::transform(wanted, wanted.begin(),
                         [](char c) { return c >= 'A' && c <= 'F' ? char(c - 'A' + 'a') : c; });
  const std::string is = archive.sha256().hex();
  if (wanted.size() < kLeast || wanted.size() > is.size() ||
      wanted.find_first_not_of("0123456789abcdef") != std::string::npos) {
    return fail(Errc::Syntax, "--sha256 {}: {} to {} hexadecimal digits", choice.sha256, kLeast,
                is.size());
  }
  if (is.starts_with(wanted)) return {};
  return fail(Errc::Corrupt, "archive {} is another file: its SHA-256 is {}, not {}", choice.file,
              is, wanted);
}

}  // namespace

Result<archive::VerifiedArchive> open_archive(const ArchiveChoice& choice, std::string_view kind) {
  auto archive = archive::VerifiedArchive::open(choice.file);
  if (!archive) return archive;
  if (archive->head().kind != kind) {
    return fail(Errc::Unsupported, "archive {} holds {}, not {}", choice.file,
                printable(archive->head().kind), kind);
  }
  if (auto good = check_digest(choice, *archive); !good) return fail(good.error());
  return archive;
}

Result<std::unique_ptr<measurement_files::MeasurementSource>> open_archived_measurements(
    const ArchiveChoice& choice, bool with_superseded) {
  auto archive = open_archive(choice, "measurements");
  if (!archive) return fail(archive.error());
  return std::make_unique<ArchiveSource>(*std::move(archive), choice.file, with_superseded);
}

bool is_archive_name(std::string_view file) {
  return has_suffix(file, ".jsonl.zst");
}

}  // namespace dripline::cli
