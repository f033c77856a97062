#include "gateway/app/state_folder.hpp"

#include "protocol/base/private_folder.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {

Result<StateFolder> StateFolder::open(const std::filesystem::path& folder) {
  const auto closed = make_private_folder(folder, {kOutbox, kJournal, kMotionJournal});
  if (!closed) return fail(closed.error().code, "state {}", closed.error().what);
  if (!closed->empty()) process::log_warning("state {}", *closed);
  auto lock = FileLock::acquire(folder / "lock", "state folder " + folder.string());
  if (!lock) return fail(lock.error());
  return StateFolder(folder, std::move(*lock));
}

}  // namespace dripline::gateway
