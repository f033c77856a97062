// The import queue over kills of its server, at any moment. DRIPLINE_KILLS changes how often (200
// by default).
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cstdlib>
#include <map>
#include <random>
#include <sstream>
#include <thread>

#include "server/imports/imports.hpp"
#include "tests/support/child_process.hpp"
#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::imports {
namespace {

using storage::ImportState;

constexpr const char* kPolicy = "[imports]\naccept_at_once = [\"comment\"]\n";

int kills() {
  const char* wanted = std::getenv("DRIPLINE_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 200;
}

/// Every third text differs from the one before in more than a comment.
std::string text_of(unsigned number) {
  return fmt::format("O1\nG21 G90 (state {})\nG0 X10.\nG1 Y{}. F100.\nM30\n", number, number / 3);
}

class KilledImports : public server_test::ServerTest {
 protected:
  KilledImports() {
    catalog_.known.push_back("fanuc");
    add_machine("mill-1", "fanuc");
    push("O1", text_of(0), "fanuc");
  }

  /// The server as another process: it receives programs, compares them, and people decide; each
  /// thing that it has confirmed is a line.
  std::string serve_and_be_killed(unsigned seed, std::chrono::microseconds life) {
    close_store();
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    EXPECT_GE(child, 0);
    if (child == 0) {
      ::close(ends[0]);
      serve(ends[1], seed);
    }
    ::close(ends[1]);
    std::string confirmed;
    char piece[256];
    const auto read_some = [&] {
      const auto count = ::read(ends[0], piece, sizeof piece);
      if (count > 0) confirmed.append(piece, static_cast<std::size_t>(count));
      return count > 0;
    };
    EXPECT_TRUE(read_some()) << "it has begun";
    std::this_thread::sleep_for(life);  // the moment of the kill is what is tried
    ::kill(child, SIGKILL);
    while (read_some()) {
    }
    ::close(ends[0]);
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it has ended by itself: " << status;
    reopen();
    return confirmed;
  }

 private:
  [[noreturn]] void serve(int to, unsigned seed) {
    reopen();
    use_policy(kPolicy);
    paths::ProgramPaths paths(
        machines::RunSources{.store = *store_, .releases = *releases_, .clock = clock_});
    Imports imports(
        {.store = *store_, .paths = paths, .policy = releases_->policy(), .clock = clock_});
    programs_->on_held([&](const auto& revision) { imports.note(revision); });
    imports.begin();
    std::mt19937 random(seed);
    const auto confirm = [&](std::string_view what, std::uint64_t revision) {
      const std::string line = fmt::format("{} {}\n", what, revision);
      if (::write(to, line.data(), line.size()) < 0) ::_exit(1);
    };
    confirm("begun", 0);
    for (;;) {
      receive(static_cast<unsigned>(random()), confirm);
      decide(imports, random, confirm);
    }
  }
  template <class Confirm>
  void receive(unsigned number, Confirm confirm) {
    const auto upload = programs_->begin(
        {.program = "O1", .control = "fanuc", .comment = "punched", .is_held = true},
        "machine mill-1");
    if (!upload) ::_exit(2);
    const std::string text = text_of(number % 100);
    if (!programs_->append(upload->id, 0, server_test::bytes_of(text))) ::_exit(3);
    const auto stored = programs_->commit(upload->id, std::nullopt, "machine mill-1");
    if (!stored) ::_exit(4);
    confirm("received", stored->revision.number);
  }
  /// What the policy decides meanwhile is refused here, and that is as it should be.
  template <class Confirm>
  void decide(Imports& imports, std::mt19937& random, Confirm confirm) {
    const auto pending = imports.list(true, {.limit = 10});
    if (!pending) ::_exit(5);
    if (pending->empty()) return;
    storage::ImportDecision decision;
    decision.program = "O1";
    decision.revision = (*pending)[random() % pending->size()].revision.number;
    decision.state =
        std::array{ImportState::Accepted, ImportState::AcceptedAs, ImportState::Rejected}.at(
            random() % 3);
    decision.who = {"anna", "token", "192.0.2.1"};
    if (decision.state == ImportState::AcceptedAs) decision.target = "O2";
    if (decision.state == ImportState::Rejected) decision.reason = "scrap";
    if (imports.decide(decision)) confirm(storage::to_string(decision.state), decision.revision);
  }
};

TEST_F(KilledImports, LoseNothingThatWasConfirmedAndDecideNothingTwice) {
  std::mt19937 random(20261127);
  std::map<std::uint64_t, std::string> decided;
  std::uint64_t received = 0;
  for (int kill = 0; kill < kills() && !HasFailure(); ++kill) {
    const std::chrono::microseconds life(std::uniform_int_distribution<>(0, 60'000)(random));
    std::istringstream lines(serve_and_be_killed(static_cast<unsigned>(random()), life));
    std::string what;
    for (std::uint64_t revision = 0; lines >> what >> revision;) {
      if (what == "begun") continue;
      if (what == "received") {
        received = std::max(received, revision);
      } else {
        EXPECT_TRUE(decided.emplace(revision, what).second) << revision << " is decided twice";
      }
    }
    ASSERT_TRUE(received == 0 || store_->imports.find("O1", received)) << "kill " << kill;
  }
  EXPECT_GT(decided.size(), 0u);

  // Afterwards what was left is compared, and what the policy takes is accepted.
  use_policy(kPolicy);
  paths::ProgramPaths paths(
      machines::RunSources{.store = *store_, .releases = *releases_, .clock = clock_});
  Imports imports(
      {.store = *store_, .paths = paths, .policy = releases_->policy(), .clock = clock_});
  imports.begin();
  ASSERT_TRUE(test_support::eventually([&] { return store_->imports.uncompared(1)->empty(); },
                                       std::chrono::seconds(120)));
  std::size_t decisions = 0;
  std::map<std::uint64_t, Digest> copies;  // the same text twice is one revision
  for (std::uint64_t number = 2; number <= received; ++number) {
    const auto import = store_->imports.find("O1", number);
    ASSERT_TRUE(import) << "revision " << number << " has no row in the queue";
    const auto confirmed = decided.find(number);
    if (confirmed != decided.end()) {
      EXPECT_EQ(storage::to_string(import->state), confirmed->second) << number;
    }
  }
  // All of them, also what was stored and not confirmed any more.
  for (std::uint64_t number = 2;; ++number) {
    const auto import = store_->imports.find("O1", number);
    if (!import) break;
    if (import->state != ImportState::Pending) ++decisions;
    if (import->state == ImportState::AcceptedAs)
      copies.emplace(import->target_revision, import->revision.content);
    EXPECT_EQ(import->decided.has_value(), import->state != ImportState::Pending) << number;
  }
  std::size_t entries = 0;
  for (storage::Page page{.limit = 1000};; page.offset += page.limit) {
    const auto some = store_->audit.list(page).value();
    for (const auto& entry : some) {
      entries += entry.action == "program.accept" || entry.action == "program.accept_as" ||
                         entry.action == "program.reject"
                     ? 1
                     : 0;
    }
    if (some.size() < page.limit) break;
  }
  EXPECT_EQ(entries, decisions) << "each decision is one entry";
  const auto accepted_as = store_->programs.revisions("O2");
  ASSERT_EQ(accepted_as ? accepted_as->size() : 0, copies.size());
  for (const auto& [number, content] : copies)
    EXPECT_EQ(store_->programs.revision("O2", number)->content, content) << number;
}

}  // namespace
}  // namespace dripline::imports
