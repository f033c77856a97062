#include "protocol/audit/trail_file.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <vector>

namespace dripline::audit {
namespace {

const SigningKey& key() {
  static const SigningKey kKey = SigningKey::of(std::string(64, '7')).value();
  return kKey;
}

Checkpoint checkpoint_of(std::uint64_t number, std::uint64_t entry, const Digest& digest) {
  Checkpoint checkpoint{number, entry, UtcTime{}, digest, {}};
  checkpoint.signature = key().sign(checkpoint_text(checkpoint, "d1"));
  return checkpoint;
}

/// Six entries, with checkpoints of the third and the sixth.
class AuditTrailFile : public testing::Test {
 protected:
  AuditTrailFile() {
    Digest digest = chain_begin("d1");
    lines.push_back(header_line({"d1", key().public_key()}));
    for (std::uint64_t n = 1; n <= 6; ++n) {
      const Entry entry{n, UtcTime{}, "anna", "", "", "run.hold", "r" + std::to_string(n), ""};
      digest = chain_next(digest, line_of(entry));
      lines.push_back(entry_line(entry, digest));
      if (n % 3 != 0) continue;
      const Checkpoint checkpoint = checkpoint_of(n / 3, n, digest);
      lines.push_back(checkpoint_line(checkpoint));
      kept.push_back(header_line({"d1", key().public_key()}) + checkpoint_line(checkpoint));
    }
    lines.push_back(end_line(6));
  }
  std::string text() const {
    std::string all;
    for (const auto& line : lines) all += line;
    return all;
  }
  /// What is reported: of the trail, else of the file; empty: nothing.
  static std::string verdict(const std::string& text, TrailReader reader = {},
                             std::size_t piece = 1 << 20) {
    Result<void> read;
    for (std::size_t at = 0; read && at < text.size(); at += piece)
      read = reader.feed(std::string_view(text).substr(at, piece));
    const auto over = read ? reader.finish() : read;
    if (reader.verifier() && reader.verifier()->first_fault())
      return reader.verifier()->first_fault()->what;
    return over ? "" : over.error().what;
  }
  static TrailReader with(const std::string& kept) {
    return TrailReader(parse_kept_checkpoint(kept).value());
  }

  std::vector<std::string> lines;  ///< 0 header, 1-3 entries, 4 checkpoint, 5-7, 8, 9 end
  std::vector<std::string> kept;
};

TEST_F(AuditTrailFile, IsVerifiedHoweverItIsCut) {
  for (const std::size_t piece : {1u, 7u, 100u, 1u << 20}) {
    EXPECT_EQ(verdict(text(), with(kept[1]), piece), "") << piece;
  }
}

TEST_F(AuditTrailFile, NamesTheFirstPlace) {
  const auto tampered = [&](auto&& change) {
    auto other = lines;
    change(other);
    std::string all;
    for (const auto& line : other) all += line;
    return verdict(all);
  };
  using Lines = std::vector<std::string>;
  const auto begins = [](const std::string& text, const std::string& with) {
    EXPECT_TRUE(text.starts_with(with)) << text;
  };
  begins(tampered([](Lines& all) { all[2].replace(all[2].find("anna"), 4, "bert"); }),
         "entry 2 is not what was written");
  begins(tampered([](Lines& all) { all.erase(all.begin() + 5); }), "entry 4 was removed");
  begins(tampered([](Lines& all) { all.insert(all.begin() + 5, all[3]); }), "entry 3 was inserted");
  begins(tampered([](Lines& all) { std::swap(all[5], all[6]); }), "entry 4 was removed");
  begins(tampered([](Lines& all) { all.erase(all.begin() + 6, all.begin() + 8); }),
         "entries 5 to 6 were removed");
  begins(tampered([](Lines& all) { all.erase(all.begin() + 4); }),
         "checkpoint 2 follows checkpoint 0");
  begins(tampered([](Lines& all) { all.resize(7); }), "the file was cut off");
  begins(tampered([](Lines& all) { all.push_back(all[1]); }), "line 11: something follows the end");
}

/// Anybody can compute a chain; the checkpoints are signed.
TEST_F(AuditTrailFile, AChainThatWasComputedAgainDoesNotFitItsCheckpoints) {
  Digest digest = chain_begin("d1");
  std::size_t line = 0;
  for (std::uint64_t n = 1; n <= 6; ++n) {
    const Entry entry{n,  UtcTime{},  n == 2 ? "bert" : "anna", "",
                      "", "run.hold", "r" + std::to_string(n),  ""};
    digest = chain_next(digest, line_of(entry));
    line += n == 4 ? 2 : 1;
    lines[line] = entry_line(entry, digest);
  }
  EXPECT_TRUE(verdict(text()).starts_with("entries 1 to 3 are not those of checkpoint 1"))
      << verdict(text());
}

/// Where its writer has the key, or there is none in it any more.
TEST_F(AuditTrailFile, IsComparedWithACheckpointThatWasKept) {
  const std::string all = text();
  lines.resize(5);
  lines.push_back(end_line(3));
  EXPECT_EQ(verdict(text()), "") << "nothing in it shows that it went on";
  EXPECT_EQ(verdict(text(), with(kept[0])), "");
  EXPECT_TRUE(verdict(text(), with(kept[1])).starts_with("the trail ends before entry 6"));
  auto other = kept[1];
  EXPECT_FALSE(parse_kept_checkpoint(other.replace(other.size() - 2, 1, "z")));
  const Checkpoint of_another = checkpoint_of(1, 3, sha256("another"));
  const std::string rewritten =
      header_line({"d1", key().public_key()}) + checkpoint_line(of_another);
  EXPECT_TRUE(verdict(all, with(rewritten)).starts_with("entry 3 is not the one")) << all;
}

TEST_F(AuditTrailFile, OfAnotherServerIsRefused) {
  const SigningKey other = SigningKey::of(std::string(64, '8')).value();
  Checkpoint checkpoint{1, 3, UtcTime{}, {}, {}};
  checkpoint.signature = other.sign(checkpoint_text(checkpoint, "d1"));
  const auto foreign = header_line({"d1", other.public_key()}) + checkpoint_line(checkpoint);
  EXPECT_NE(verdict(text(), with(foreign)).find("the kept checkpoint is of"), std::string::npos);
  lines[0] = header_line({"d1", other.public_key()});
  EXPECT_TRUE(verdict(text()).starts_with("checkpoint 1 (entry 3) is not signed"));
}

TEST_F(AuditTrailFile, HasShortLines) {
  TrailReader reader;
  const std::string line(TrailReader::kMaxLine + 1, 'x');
  EXPECT_EQ(reader.feed(line).error().code, Errc::LimitExceeded);
}

}  // namespace
}  // namespace dripline::audit
