#pragma once

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <string_view>

#include "server/library/attachments.hpp"
#include "server/library/audit_chain.hpp"
#include "server/library/audit_trail.hpp"
#include "server/library/control_catalog.hpp"
#include "server/library/history/run_history.hpp"
#include "server/library/program_search.hpp"
#include "server/library/programs.hpp"
#include "server/library/releases.hpp"
#include "server/library/setups.hpp"
#include "storage/sqlite_store.hpp"
#include "tests/support/manual_clock.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::server_test {

/// Two controls, unless a test knows more; a text that begins with `%C` is for the first, one with
/// `%2` for both.
class FakeCatalog final : public library::ControlCatalog {
 public:
  std::vector<std::string> known = {"centurion", "tnc155"};

  std::vector<std::string> names() const override { return known; }
  std::vector<std::string> detect(std::string_view head, std::string_view) const override {
    if (head.starts_with("%C")) return {"centurion"};
    if (head.starts_with("%2")) return {"centurion", "tnc155"};
    return {};
  }
  Result<void> check_setup(std::string_view control, std::string_view toml) const override {
    if (toml.find("wrong") == std::string_view::npos) return {};
    return fail(Errc::Syntax, "line 1: wrong is nothing a {} knows", control);
  }
  bool is_protected(std::string_view control, std::string_view head) const override {
    return control == "tnc155" && head.starts_with("%2 LOCKED");
  }
};

inline std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

/// A real store in a folder of its own, with the library on top.
class ServerTest : public testing::Test {
 protected:
  using Run = storage::Run;  // and not Google Test's function

  ServerTest() { reopen(); }

  /// Another process may have it, until `reopen`.
  void close_store() {
    search_.reset();
    attachments_.reset();
    setups_.reset();
    releases_.reset();
    runs_.reset();
    programs_.reset();
    chain_.reset();
    audit_.reset();
    store_.reset();
  }
  void reopen() {
    const bool has_search = search_ != nullptr;
    close_store();
    auto opened = storage::SqliteStore::open({.file = folder_.path() / "store.sqlite"}, clock_);
    EXPECT_TRUE(opened) << opened.error().what;
    store_ = *std::move(opened);
    audit_ = std::make_unique<library::AuditTrail>(store_->audit, clock_);
    chain_ = std::make_unique<library::AuditChain>(
        library::AuditChain::Parts{.store = store_->audit,
                                   .clock = clock_,
                                   .key = SigningKey::of(std::string(64, '7')).value(),
                                   .database = store_->identity().value()});
    programs_ = std::make_unique<library::Programs>(*store_, clock_, catalog_, *audit_);
    runs_ = std::make_unique<library::RunHistory>(*store_);
    setups_ = std::make_unique<library::Setups>(store_->setups, catalog_, *audit_);
    attachments_ = std::make_unique<library::Attachments>(*store_);
    if (has_search) start_search();
    use_policy("");
  }
  /// Its thread writes to the store from now on.
  void start_search() { search_ = std::make_unique<library::ProgramSearch>(*store_); }
  /// The policy's text, from now on.
  void use_policy(const std::string& toml) {
    auto policy = library::ReleasePolicy::parse(toml);
    ASSERT_TRUE(policy) << policy.error().what;
    releases_ = std::make_unique<library::Releases>(
        library::Releases::Parts{.store = *store_,
                                 .clock = clock_,
                                 .key = SigningKey::of(std::string(64, '7')).value(),
                                 .database = store_->identity().value()},
        *std::move(policy));
  }

  std::string begin(const std::string& program, const std::string& control = "centurion") {
    auto upload = programs_->begin({.program = program, .control = control, .comment = {}}, "cam");
    EXPECT_TRUE(upload) << upload.error().what;
    return upload ? upload->id : "";
  }
  storage::Revision push(const std::string& program, std::string_view text,
                         const std::string& control = "centurion") {
    const std::string id = begin(program, control);
    constexpr std::size_t kPiece = 1 << 20;
    for (std::size_t at = 0; at < text.size(); at += kPiece) {
      const auto appended = programs_->append(id, at, bytes_of(text.substr(at, kPiece)));
      EXPECT_TRUE(appended) << appended.error().what;
    }
    auto committed = programs_->commit(id, std::nullopt, "cam");
    EXPECT_TRUE(committed) << committed.error().what;
    return committed ? committed->revision : storage::Revision{};
  }
  void add_machine(const std::string& name, const std::string& control = "centurion") {
    storage::Machine machine;
    machine.name = name;
    machine.control = control;
    machine.epoch = 7;
    machine.first_seen = machine.last_seen = clock_.now();
    EXPECT_TRUE(store_->machines.save(machine));
  }
  /// A run of `revision` on lathe-1, not stored yet.
  Run run_of(const storage::Revision& revision, const std::string& id) const {
    Run run;
    run.id = id;
    run.machine = "lathe-1";
    run.program = revision.program;
    run.revision = revision.number;
    run.content = revision.content;
    run.size = revision.size;
    run.control = "centurion";
    run.created = clock_.now();
    return run;
  }

  test_support::TemporaryFolder folder_;
  test_support::ManualClock clock_;
  FakeCatalog catalog_;
  std::unique_ptr<storage::SqliteStore> store_;
  std::unique_ptr<library::AuditTrail> audit_;
  std::unique_ptr<library::AuditChain> chain_;
  std::unique_ptr<library::Programs> programs_;
  std::unique_ptr<library::RunHistory> runs_;
  std::unique_ptr<library::Setups> setups_;
  std::unique_ptr<library::Releases> releases_;
  std::unique_ptr<library::Attachments> attachments_;
  std::unique_ptr<library::ProgramSearch> search_;
};

}  // namespace dripline::server_test
