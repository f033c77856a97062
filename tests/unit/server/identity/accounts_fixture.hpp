#pragma once

#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/identity/accounts.hpp"
#include "storage/sqlite_store.hpp"
#include "tests/support/manual_clock.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::identity {

using From = PresentedSecret::From;

/// Forwards to a real store until `is_broken`.
class FailingStore final : public storage::AccountStore {
 public:
  explicit FailingStore(storage::AccountStore& inner) : inner_(inner) {}
  bool is_broken = false;

  Result<storage::AccountData> load() override { return inner_.load(); }
  Result<void> save_user(const User& user, const std::vector<std::string>& ended) override {
    return is_broken ? broken() : inner_.save_user(user, ended);
  }
  Result<void> save_credential(const Credential& credential,
                               const std::vector<std::string>& ended) override {
    return is_broken ? broken() : inner_.save_credential(credential, ended);
  }
  Result<void> remove_credentials(const std::string& user,
                                  const std::vector<std::string>& names) override {
    return is_broken ? broken() : inner_.remove_credentials(user, names);
  }
  Result<void> note_uses(const std::vector<storage::CredentialUse>& uses) override {
    return is_broken ? broken() : inner_.note_uses(uses);
  }
  Result<void> save_group(const MachineGroup& group) override {
    return is_broken ? broken() : inner_.save_group(group);
  }
  Result<void> remove_group(const std::string& name) override {
    return is_broken ? broken() : inner_.remove_group(name);
  }

 private:
  static Result<void> broken() { return fail(Errc::Io, "disk full"); }
  storage::AccountStore& inner_;
};

inline const std::string kLocalSecret(64, '0');
inline const std::string kPassword = "correct horse";

class AccountsTest : public testing::Test {
 protected:
  AccountsTest() { reopen(); }

  /// As after a restart of the server.
  void reopen(PasswordHasher::Options hashing = {.cost = {.passes = 1, .memory = 8192}}) {
    accounts_.reset();
    audit_.reset();
    failing_.reset();
    store_.reset();
    store_ = storage::SqliteStore::open({.file = folder_.path() / "store.sqlite"}, clock_).value();
    failing_ = std::make_unique<FailingStore>(store_->accounts);
    audit_ = std::make_unique<library::AuditTrail>(store_->audit, clock_);
    auto opened = Accounts::open({.store = *failing_, .audit = *audit_, .clock = clock_},
                                 {.hashing = hashing, .attempts = {.of_user = 5}});
    ASSERT_TRUE(opened) << opened.error().what;
    accounts_ = *std::move(opened);
    ASSERT_TRUE(accounts_->use_local_secret(kLocalSecret, false));
  }
  Accounts& accounts() { return *accounts_; }
  Caller admin() { return find(kLocalSecret).value(); }
  std::optional<Caller> find(const std::string& secret, From from = From::Bearer) {
    return accounts_->find({from, secret}, "192.0.2.1");
  }
  void add(const std::string& name, Role role, const std::set<std::string>& groups = {}) {
    const auto added = accounts_->users().add(
        admin(), {.name = name, .role = role, .groups = groups, .password = kPassword});
    ASSERT_TRUE(added) << added.error().what;
  }
  void add_group(const std::string& name, const std::vector<std::string>& machines) {
    ASSERT_TRUE(accounts_->groups().add(admin(), name));
    for (const auto& machine : machines)
      ASSERT_TRUE(accounts_->groups().add_machine(admin(), name, machine));
  }
  Result<Issued> sign_in(const std::string& user, const std::string& password = kPassword,
                         const std::string& address = "192.0.2.1") {
    return accounts_->sessions().sign_in(
        {.user = user, .password = password, .address = address, .kind = CredentialKind::Login});
  }
  std::optional<Caller> signed_in(const std::string& user) { return find(sign_in(user)->secret); }
  std::string token(const Caller& by, const std::string& user, const NewToken& wanted) {
    const auto issued = accounts_->tokens().add(by, user, wanted);
    EXPECT_TRUE(issued) << issued.error().what;
    return issued ? issued->secret : "";
  }
  std::vector<std::string> audited(const std::string& action) {
    accounts_->refusals().flush();
    std::vector<std::string> entries;
    const auto list = audit_->entries({});
    for (const auto& entry : list.value()) {
      if (entry.action == action)
        entries.push_back(fmt::format("{} {} {} {}", entry.who.name, entry.who.address,
                                      entry.subject, entry.detail));
    }
    return entries;
  }

  test_support::TemporaryFolder folder_;
  test_support::ManualClock clock_;
  std::unique_ptr<storage::SqliteStore> store_;
  std::unique_ptr<FailingStore> failing_;
  std::unique_ptr<library::AuditTrail> audit_;
  std::unique_ptr<Accounts> accounts_;
};

}  // namespace dripline::identity
