#pragma once

#include "storage/account_store.hpp"
#include "storage/impl/connections.hpp"

namespace dripline::storage {

/// Thread-safe.
class AccountRepository final : public AccountStore {
 public:
  explicit AccountRepository(Connections& connections) : connections_(connections) {}

  Result<AccountData> load() override;
  Result<void> save_user(const User& user, const std::vector<std::string>& ended) override;
  Result<void> save_credential(const Credential& credential,
                               const std::vector<std::string>& ended) override;
  Result<void> remove_credentials(const std::string& user,
                                  const std::vector<std::string>& names) override;
  Result<void> note_uses(const std::vector<CredentialUse>& uses) override;
  Result<void> save_group(const MachineGroup& group) override;
  Result<void> remove_group(const std::string& name) override;

 private:
  Connections& connections_;
};

}  // namespace dripline::storage
