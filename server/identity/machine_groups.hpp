#pragma once

#include <functional>
#include <string>
#include <vector>

#include "server/identity/account_book.hpp"

namespace dripline::identity {

/// The groups of machines. Errors of changes: as of Accounts. Any thread.
class MachineGroups {
 public:
  explicit MachineGroups(AccountBook& book) : book_(book) {}

  struct Saved {
    MachineGroup group;
    bool is_new = false;
  };
  std::vector<MachineGroup> list() const;
  Result<Saved> add(const Caller& by, const std::string& name);
  Result<void> remove(const Caller& by, const std::string& name);
  Result<MachineGroup> add_machine(const Caller& by, const std::string& group,
                                   const std::string& machine);
  Result<MachineGroup> remove_machine(const Caller& by, const std::string& group,
                                      const std::string& machine);

 private:
  Result<MachineGroup> change(const Caller& by, const std::string& name,
                              const std::function<void(MachineGroup&)>& change,
                              const std::string& detail);

  AccountBook& book_;
};

}  // namespace dripline::identity
