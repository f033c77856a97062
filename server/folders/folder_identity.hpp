#pragma once

#include <sys/stat.h>
#include <filesystem>
#include <string>
#include <vector>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/result.hpp"

namespace dripline::folders {

/// Which folder it is, whatever names lead to it.
struct FolderIdentity {
  dev_t device = 0;
  ino_t number = 0;
  bool operator==(const FolderIdentity&) const = default;
};

/// An error of the system, with what it was about. Errors by `errno`'s meaning: NotFound, Conflict
/// (it exists), Denied, Busy (another computer may have it open), Io.
Error system_error(const std::string& what, int error);

/// Errors: Io.
Result<FolderIdentity> identity_of(int folder);
/// The folder itself, never the target of a symbolic link; `parent` is AT_FDCWD for a path. Never
/// waits for a pipe. Errors: NotFound, Denied (also: it is a link), Io.
Result<Descriptor> open_folder(int parent, const std::string& name);
/// That `name` still leads to the folder itself. Errors: NotFound (nothing has the name), Conflict
/// (another folder, or a link, has it), Io.
Result<void> check_same(int parent, const std::string& name, const FolderIdentity& expected);
/// That the folder is none of the server's own, holds none and lies in none, by device and inode
/// along the parents: what is in those would be taken as programs. Errors: Denied, Io.
Result<void> check_apart(int folder, const std::vector<std::filesystem::path>& own);

}  // namespace dripline::folders
