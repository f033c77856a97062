#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>

#include "server/folders/folder_files.hpp"
#include "server/folders/name_rules.hpp"
#include "server/library/control_catalog.hpp"
#include "server/library/programs.hpp"
#include "server/machines/run_sources.hpp"

namespace dripline::folders {

/// What was noticed of the names in a folder since the last look (inotify).
struct Arrivals {
  std::set<std::string> whole;    ///< renamed into the folder: complete at once
  std::set<std::string> written;  ///< written to, and not closed yet
};

/// A hot folder for people: what it is, and how its last look went.
struct FolderState {
  FolderSettings settings;
  std::string fault;  ///< why it cannot be read, or why files cannot be moved; empty: it can
  std::optional<UtcTime> looked;  ///< last; absent: not yet
  std::uint64_t waiting = 0;      ///< files that are not complete yet, or wait for another try
  storage::FolderCounts counts;
  std::string last_refused, last_reason;  ///< since the server started
};

/// Takes the programs that others write into one folder: looks, waits until a file is complete,
/// names it, checks it, stores it, and moves it away. A kill at any moment leaves no file taken
/// twice or lost: the row of a file is stored with its revision in one transaction, and what the
/// row says is done again until the file is moved. `look` on one thread, `state` on any; all of
/// Parts must outlive it.
class HotFolder {
 public:
  struct Parts {
    library::Programs& programs;
    const library::ControlCatalog& catalog;
    machines::RunSources sources;
    std::filesystem::path spool;  ///< for copies while they are checked
    /// Of the server: a hot folder that is, holds or lies in one of them is refused.
    std::vector<std::filesystem::path> own_folders = {};
    /// Why the folder cannot be worked with; empty: it can. After every look.
    std::function<void(const std::string& folder, const std::string& fault)> on_fault = {};
    /// A file was stored or refused. It must return soon.
    std::function<void(const storage::FolderFile&)> on_file = {};
  };
  HotFolder(const Parts& parts, FolderSettings settings);

  /// Takes what is complete. Returns when to look again at the latest. It may wait for storage, the
  /// network of a share, and the check of a program.
  SteadyTime look(const Arrivals& arrivals, const std::stop_token& stop);
  FolderState state() const;
  /// From time to time, on any thread: a folder that does not answer (AnswerWatch::kPatience) is a
  /// fault, and its own thread cannot report it.
  void report_silence();
  /// Of `look`'s thread: a path of the very folder that was opened; empty: none is.
  std::filesystem::path watched_path() const;
  const FolderSettings& settings() const { return settings_; }

  /// After this, what failed for a reason that may pass is tried again.
  static constexpr std::chrono::seconds kRetry{15};

 private:
  /// A file that is being waited for.
  struct Watched {
    Entry entry;
    SteadyTime unchanged_since;
    SteadyTime not_before;  ///< after a failure that may pass
  };
  /// A file that is complete, as it was copied.
  struct Taken {
    Entry entry;
    std::optional<FileCopy> copy;  ///< absent: it is no file, or cannot be read
    std::string reason;            ///< why it is refused unseen; empty: it is not
  };

  Result<void> open_or_check();
  std::string silence_fault() const;
  Result<void> look_through(const Arrivals& arrivals, const std::stop_token& stop);
  Result<void> finish_interrupted(const std::map<std::string_view, const Entry*>& entries);
  bool is_complete(const Entry& entry, const Arrivals& arrivals);
  void refuse_folder(const Entry& entry);
  Result<void> take(const Entry& entry, const std::stop_token& stop);
  Result<Taken> read(const Entry& entry) const;
  Result<std::optional<storage::FolderFile>> known(const Taken& taken);
  Result<storage::FolderFile> judge(const Taken& taken, const std::stop_token& stop);
  Result<NamedProgram> name(const Taken& taken) const;
  Result<void> check(const NamedProgram& named, const FileCopy& copy,
                     const std::stop_token& stop) const;
  Result<storage::FolderFile> store(const Taken& taken, const NamedProgram& named);
  Result<storage::Revision> upload(const NamedProgram& named, const FileCopy& copy,
                                   std::uint64_t file);
  Result<storage::FolderFile> refuse(const Taken& taken, const std::string& reason);
  Result<void> move_away(const storage::FolderFile& file);
  void note(const storage::FolderFile& file);
  void set_fault(const Result<void>& looked);
  storage::FolderFile row_of(const Taken& taken) const;

  const Parts parts_;
  const FolderSettings settings_;
  AnswerWatch answers_;
  std::optional<FolderFiles> files_;        ///< from the first time that the folder could be opened
  std::map<std::string, Watched> watched_;  ///< by name
  std::set<std::string> refused_folders_;
  SteadyTime next_;
  std::mutex reporting_;    ///< before `mutex_`: what is reported last is what is last
  bool is_silent_ = false;  ///< reported so; under `reporting_`
  mutable std::mutex mutex_;
  FolderState state_;
};

}  // namespace dripline::folders
