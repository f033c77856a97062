#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"
#include "server/folders/answer_watch.hpp"
#include "server/folders/folder_identity.hpp"
#include "server/folders/folder_settings.hpp"

namespace dripline::folders {

/// What is seen of an entry of a folder without opening it.
struct Entry {
  enum class Kind : std::uint8_t { File, Folder, Other };
  std::string name;
  Kind kind = Kind::File;
  std::string what;  ///< of what is no file: "a symbolic link"
  std::uint64_t size = 0;
  std::int64_t changed_ns = 0;

  bool is_unchanged(const Entry& other) const {
    return size == other.size && changed_ns == other.changed_ns && kind == other.kind;
  }
};

/// Our own copy of a file's bytes: no one else can change or cut it off while it is read. It has no
/// name and is gone with the object.
class FileCopy {
 public:
  FileCopy(Descriptor file, std::uint64_t size, const Digest& digest);
  FileCopy(FileCopy&& other) noexcept;
  FileCopy& operator=(FileCopy&&) = delete;
  ~FileCopy();

  std::string_view text() const { return {bytes_, size_}; }
  const Digest& digest() const { return digest_; }
  /// The account that owned the very file that was read; empty: not known.
  const std::string& owner() const { return owner_; }
  void set_owner(std::string owner) { owner_ = std::move(owner); }
  /// Errors: Io.
  Result<void> map();

 private:
  Descriptor file_;
  std::uint64_t size_ = 0;
  Digest digest_;
  std::string owner_;
  const char* bytes_ = nullptr;
};

/// A hot folder, with its folders for what is done and what failed. They are opened once; whatever
/// has their names later, everything is done below the folders that were opened. Nothing here
/// follows a symbolic link, or waits for a pipe. It may wait for the network where the folder is a
/// share.
class FolderFiles {
 public:
  struct Options {
    const FolderSettings& settings;
    const std::vector<std::filesystem::path>& own_folders;  ///< of the server: never a hot folder
    AnswerWatch& answers;                                   ///< must outlive it
  };
  /// Makes the two folders where they are missing. Errors: NotFound, Denied (also: a link is at the
  /// path, or it has to do with the server's own folders), Io.
  static Result<FolderFiles> open(const Options& options);
  /// That the names still lead to the folders that were opened; one of the two that is missing is
  /// made again. Errors: NotFound, Conflict (another folder, or a link, has the name), Denied, Io.
  Result<void> check();
  /// For what wants a path of the very folder that was opened.
  std::filesystem::path descriptor_path() const;

  /// All entries but those two folders, by their time of change. Errors: Io, LimitExceeded (more
  /// than kMaxEntries).
  Result<std::vector<Entry>> list() const;
  /// Errors: NotFound.
  Result<Entry> look_at(const std::string& name) const;
  /// Copies the file's bytes into `spool`, while it stays as it was seen. Errors: Busy (it is open
  /// for writing, or has changed: try again), Denied (it cannot be read, or has another name too: a
  /// hard link may be one to a file that its maker cannot read), LimitExceeded, Io.
  Result<FileCopy> copy(const Entry& seen, const std::filesystem::path& spool,
                        std::uint64_t max_bytes) const;

  /// A name below `folder` (done or failed) that no file has: `name`, else with a number.
  Result<std::string> free_target(const std::string& folder, const std::string& name) const;
  /// Never over another file. Errors: Conflict (the target is there), NotFound, Io, Denied.
  Result<void> move(const std::string& name, const std::string& target) const;
  bool has(const std::string& path) const;
  /// A text file beside a failed one; whole or not at all, and readable for who may read the
  /// folder.
  Result<void> write_reason(const std::string& target, const std::string& reason) const;

  static constexpr std::size_t kMaxEntries = 10'000;

 private:
  struct Subfolder {
    std::string name;
    Descriptor folder = {};
    FolderIdentity identity = {};
  };
  struct Place {
    int folder = -1;
    std::string name;
  };
  FolderFiles(const Options& options, Descriptor folder);
  Place place_of(const std::string& target) const;
  bool is_there(const std::string& path) const;
  Result<void> open_subfolder(Subfolder& sub);
  Result<void> check_subfolder(Subfolder& sub);

  std::filesystem::path path_;
  std::vector<std::filesystem::path> own_folders_;
  AnswerWatch* answers_;
  Descriptor folder_;
  FolderIdentity identity_;
  Subfolder done_, failed_;
};

}  // namespace dripline::folders
