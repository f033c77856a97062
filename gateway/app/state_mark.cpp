#include "gateway/app/state_mark.hpp"

#include <cerrno>
#include <system_error>

#include "protocol/base/durable_file.hpp"

namespace dripline::gateway {

bool StateMark::is_set() const {
  if (file_.empty()) return false;
  std::error_code failure;
  return std::filesystem::exists(file_, failure) || failure;
}

Result<void> StateMark::set() const {
  if (file_.empty() || replace_private_file(file_, "")) return {};
  return fail(Errc::Io, "{}: {}", file_.string(), std::generic_category().message(errno));
}

Result<void> StateMark::clear() const {
  if (file_.empty()) return {};
  std::error_code failure;
  const bool was_there = std::filesystem::remove(file_, failure);
  if (failure) return fail(Errc::Io, "{}: {}", file_.string(), failure.message());
  if (was_there) static_cast<void>(sync_folder(file_.parent_path()));
  return {};
}

}  // namespace dripline::gateway
