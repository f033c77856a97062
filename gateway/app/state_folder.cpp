#include "gateway/app/state_folder.hpp"

#include <system_error>

namespace dripline::gateway {

Result<StateFolder> StateFolder::open(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(Errc::Io, "state folder {}: {}", folder.string(), error.message());
  auto lock = FileLock::acquire(folder / "lock", "state folder " + folder.string());
  if (!lock) return fail(lock.error());
  return StateFolder(folder, std::move(*lock));
}

}  // namespace dripline::gateway
