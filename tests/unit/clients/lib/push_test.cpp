#include "clients/lib/push.hpp"

#include <gtest/gtest.h>
#include <algorithm>

#include "tests/unit/clients/support/fake_server.hpp"

namespace dripline::client {
namespace {

using test_support::FakeServer;

/// Bytes from memory that count what is asked for at once.
class TextSource final : public ByteSource {
 public:
  explicit TextSource(std::string text) : text_(std::move(text)) {}
  std::uint64_t size() const override { return text_.size(); }
  Result<void> read(std::uint64_t offset, std::span<char> into) override {
    longest_read = std::max(longest_read, into.size());
    std::copy_n(text_.data() + offset, into.size(), into.data());
    return {};
  }
  std::size_t longest_read = 0;

 private:
  std::string text_;
};

/// More than two pieces, no two places alike.
std::string long_program() {
  std::string text;
  for (int i = 0; text.size() < 9'000'000; ++i) text += "N" + std::to_string(i) + " X1.5\n";
  return text;
}

class Push : public testing::Test {
 protected:
  Push() {
    options.upload.program = "O0200";
    options.retry.wait = [this](std::chrono::milliseconds time) {
      waited.push_back(time);
      return true;
    };
  }
  Reply<Revision> push(const std::string& text) {
    TextSource source(text);
    auto revision = push_program(client, source, options);
    longest_read = source.longest_read;
    return revision;
  }
  FakeServer server;
  Client client{ServerAddress{server.url(), FakeServer::kToken, {}}};
  PushOptions options;
  std::vector<std::chrono::milliseconds> waited;
  std::size_t longest_read = 0;
};

TEST_F(Push, SendsInPiecesAndCommits) {
  const std::string text = long_program();
  const auto revision = push(text);
  ASSERT_TRUE(revision) << revision.error().what;
  EXPECT_EQ(revision->revision, 1u);
  EXPECT_FALSE(revision->unchanged);
  EXPECT_TRUE(server.content("O0200") == text);
  EXPECT_EQ(server.pieces_received(), 3);
  EXPECT_LE(longest_read, 4u * 1024 * 1024);
}

TEST_F(Push, ReportsAnUnchangedRevision) {
  server.add_program("O0200", "M30\n");
  const auto revision = push("M30\n");
  ASSERT_TRUE(revision);
  EXPECT_TRUE(revision->unchanged);
  EXPECT_EQ(server.revisions("O0200"), 1u);
}

TEST_F(Push, ContinuesWhereTheServerStoppedReceiving) {
  server.fail_piece({});
  server.fail_piece({1'000'001, 0, "", false});
  server.fail_piece({4 * 1024 * 1024, 0, "", false});
  const std::string text = long_program();
  const auto revision = push(text);
  ASSERT_TRUE(revision) << revision.error().what;
  EXPECT_TRUE(server.content("O0200") == text);
  EXPECT_EQ(waited.size(), 3u);
}

TEST_F(Push, TriesAgainWhenTheServerIsBusy) {
  server.fail_piece({0, 409, "busy", false});
  const auto revision = push("M30\n");
  ASSERT_TRUE(revision) << revision.error().what;
  EXPECT_EQ(server.content("O0200"), "M30\n");
}

TEST_F(Push, EndsAtOnceWhenAPieceIsRefused) {
  server.fail_piece({0, 413, "limit_exceeded", false});
  const auto revision = push("M30\n");
  ASSERT_FALSE(revision);
  EXPECT_EQ(revision.error().kind, Failure::Kind::Refused);
  EXPECT_EQ(revision.error().what, "fake: limit_exceeded");
  EXPECT_EQ(server.pieces_received(), 1);
  EXPECT_EQ(server.uploads_open(), 0);
}

TEST_F(Push, ReportsTheReasonWhenTheServerDropsTheUploadWithTheRefusal) {
  server.fail_piece({0, 422, "unsupported", true});
  const auto revision = push("hello\n");
  ASSERT_FALSE(revision);
  EXPECT_EQ(revision.error().what, "fake: unsupported");
}

TEST_F(Push, FindsACommitWhoseAnswerWasLost) {
  server.lose_commit_answer();
  const auto revision = push("G1 X1\nM30\n");
  ASSERT_TRUE(revision) << revision.error().what;
  EXPECT_EQ(revision->revision, 1u);
  EXPECT_EQ(server.revisions("O0200"), 1u);
}

TEST_F(Push, GivesUpAfterTheStatedAttempts) {
  options.retry.attempts = 3;
  for (int i = 0; i < 20; ++i) server.fail_piece({});
  const auto revision = push("M30\n");
  ASSERT_FALSE(revision);
  EXPECT_EQ(revision.error().kind, Failure::Kind::Unreachable);
  EXPECT_EQ(waited, (std::vector<std::chrono::milliseconds>{
                        options.retry.first, options.retry.first * 2, options.retry.first * 4}));
}

TEST_F(Push, EndsWhenTheUserWantsIt) {
  options.on_progress = [](std::uint64_t done, std::uint64_t) { return done < 5'000'000; };
  const auto revision = push(long_program());
  ASSERT_FALSE(revision);
  EXPECT_EQ(server.revisions("O0200"), 0u);
  EXPECT_TRUE(waited.empty());
}

TEST_F(Push, ReportsProgressUpToTheEnd) {
  std::uint64_t last = 0;
  options.on_progress = [&](std::uint64_t done, std::uint64_t total) {
    EXPECT_GE(done, last);
    EXPECT_EQ(total, 9u);
    last = done;
    return true;
  };
  ASSERT_TRUE(push("G1X1\nM30\n"));
  EXPECT_EQ(last, 9u);
}

TEST_F(Push, IsDeniedWithAWrongToken) {
  Client stranger{ServerAddress{server.url(), "wrong", {}}};
  TextSource source("M30\n");
  const auto revision = push_program(stranger, source, options);
  ASSERT_FALSE(revision);
  EXPECT_EQ(revision.error().kind, Failure::Kind::Denied);
  EXPECT_TRUE(waited.empty());
}

}  // namespace
}  // namespace dripline::client
