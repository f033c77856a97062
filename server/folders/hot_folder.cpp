#include "server/folders/hot_folder.hpp"

#include <algorithm>

#include "protocol/process/log.hpp"
#include "server/paths/text_check.hpp"

namespace dripline::folders {
namespace {

using storage::FolderFile;
using storage::FolderFileState;

constexpr std::size_t kTextPiece = 4 * 1024 * 1024;
constexpr std::size_t kMaxReason = 1024;

/// Not the file's fault: another time it may go well.
bool is_passing(const Error& error) {
  return error.code == Errc::Busy || error.code == Errc::Io || error.code == Errc::Timeout;
}

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

}  // namespace

HotFolder::HotFolder(const Parts& parts, FolderSettings settings)
    : parts_(parts),
      settings_(std::move(settings)),
      answers_(parts.sources.clock),
      next_(parts.sources.clock.steady_now()) {
  state_.settings = settings_;
}

FolderState HotFolder::state() const {
  const std::string silence = silence_fault();
  const std::lock_guard lock(mutex_);
  FolderState state = state_;
  if (!silence.empty()) state.fault = silence;
  return state;
}

std::filesystem::path HotFolder::watched_path() const {
  return files_ ? files_->descriptor_path() : std::filesystem::path();
}

/// Empty: it answers.
std::string HotFolder::silence_fault() const {
  const auto silence = answers_.silence();
  if (silence < AnswerWatch::kPatience) return {};
  return fmt::format("{} has not answered for {} s", settings_.path.string(), silence.count());
}

void HotFolder::report_silence() {
  const std::lock_guard reporting(reporting_);
  const std::string fault = silence_fault();
  if (fault.empty()) return;
  const bool is_new = !std::exchange(is_silent_, true);
  if (is_new) process::log_warning("folder={}: {}", settings_.name, fault);
  if (parts_.on_fault) parts_.on_fault(settings_.name, fault);
}

/// The folder that was opened stays the hot folder: another one at its path, or at that of its two
/// folders, may be one that someone wants the server to read and to empty.
Result<void> HotFolder::open_or_check() {
  if (files_) return files_->check();
  auto files = FolderFiles::open(
      {.settings = settings_, .own_folders = parts_.own_folders, .answers = answers_});
  if (!files) return fail(files.error());
  files_.emplace(*std::move(files));
  return {};
}

SteadyTime HotFolder::look(const Arrivals& arrivals, const std::stop_token& stop) {
  const Clock& clock = parts_.sources.clock;
  next_ = clock.steady_now() + settings_.poll;
  Result<void> looked = open_or_check();
  if (looked) looked = look_through(arrivals, stop);
  set_fault(looked);
  const auto counts = parts_.sources.store.folders.counts(settings_.name);
  const std::lock_guard lock(mutex_);
  state_.looked = clock.now();
  state_.waiting = watched_.size();
  if (counts) state_.counts = *counts;
  return next_;
}

void HotFolder::set_fault(const Result<void>& looked) {
  const std::string fault = looked ? std::string() : looked.error().what;
  const std::lock_guard reporting(reporting_);
  if (std::exchange(is_silent_, false))
    process::log_info("folder={}: it answers again", settings_.name);
  {
    const std::lock_guard lock(mutex_);
    if (fault != state_.fault && !fault.empty())
      process::log_warning("folder={}: {}", settings_.name, fault);
    state_.fault = fault;
  }
  if (parts_.on_fault) parts_.on_fault(settings_.name, fault);
}

/// The first fault of the folder itself; a file's fault does not keep others from being taken.
Result<void> HotFolder::look_through(const Arrivals& arrivals, const std::stop_token& stop) {
  const auto entries = files_->list();
  if (!entries) return fail(entries.error());
  std::map<std::string_view, const Entry*> by_name;
  for (const Entry& entry : *entries) by_name.emplace(entry.name, &entry);
  if (auto done = finish_interrupted(by_name); !done) return done;
  std::erase_if(watched_, [&](const auto& watched) { return !by_name.contains(watched.first); });
  Result<void> first;
  for (const Entry& entry : *entries) {
    if (stop.stop_requested()) break;
    if (is_temporary_name(entry.name)) continue;
    const auto named = name_program(settings_, entry.name, "");
    if (named && named->is_ignored) continue;
    if (entry.kind == Entry::Kind::Folder) {
      refuse_folder(entry);
      continue;
    }
    if (!is_complete(entry, arrivals)) continue;
    auto taken = take(entry, stop);
    if (taken) {
      watched_.erase(entry.name);
      continue;
    }
    Watched& watched = watched_.at(entry.name);
    watched.unchanged_since = parts_.sources.clock.steady_now();
    const bool is_changing = taken.error().code == Errc::Busy;
    watched.not_before =
        watched.unchanged_since + (is_changing ? settings_.unchanged_time : kRetry);
    next_ = std::min(next_, watched.not_before);
    if (!is_changing && first) first = fail(taken.error().code, "{}", taken.error().what);
  }
  return first;
}

/// Rows of files that were moved, and the server was killed before it wrote that down.
Result<void> HotFolder::finish_interrupted(
    const std::map<std::string_view, const Entry*>& entries) {
  auto& store = parts_.sources.store.folders;
  const auto unfinished = store.unfinished(settings_.name);
  if (!unfinished) return fail(unfinished.error());
  for (const auto& file : *unfinished) {
    const auto found = entries.find(file.name);
    const bool is_there = found != entries.end() && found->second->changed_ns == file.changed_ns &&
                          found->second->size == file.size;
    if (is_there) continue;
    if (file.state == FolderFileState::Taken) {
      if (auto failed = store.fail_file(file.id, "it was gone before it was stored"); !failed)
        return failed;
    }
    if (auto moved = store.set_moved(file.id, parts_.sources.clock.now()); !moved) return moved;
  }
  return {};
}

bool HotFolder::is_complete(const Entry& entry, const Arrivals& arrivals) {
  const SteadyTime now = parts_.sources.clock.steady_now();
  auto [found, is_new] = watched_.try_emplace(entry.name, Watched{entry, now, now});
  Watched& watched = found->second;
  if (!is_new && !watched.entry.is_unchanged(entry)) {
    watched.entry = entry;
    watched.unchanged_since = now;
  }
  if (arrivals.whole.contains(entry.name)) watched.unchanged_since = now - settings_.unchanged_time;
  if (arrivals.written.contains(entry.name)) {
    watched.unchanged_since = now;
    return false;  // closing it wakes us
  }
  const SteadyTime due =
      std::max(watched.unchanged_since + settings_.unchanged_time, watched.not_before);
  if (due <= now) return true;
  next_ = std::min(next_, due);
  return false;
}

/// It stays: its maker may be in it.
void HotFolder::refuse_folder(const Entry& entry) {
  if (!refused_folders_.insert(entry.name).second) return;
  const std::string shown = printable_name(entry.name);
  const std::string target = settings_.failed + "/" + shown;
  const std::string reason = fmt::format("{}: it is a folder, and only files are taken", shown);
  process::log_warning("folder={} {}", settings_.name, reason);
  if (files_->has(target + ".reason.txt")) return;
  if (auto written = files_->write_reason(target, reason); !written)
    process::log_warning("folder={} {}", settings_.name, written.error().what);
}

Result<void> HotFolder::take(const Entry& entry, const std::stop_token& stop) {
  auto taken = read(entry);
  if (!taken) return fail(taken.error());
  auto file = known(*taken);
  if (!file) return fail(file.error());
  if (!*file) {
    auto judged = judge(*taken, stop);
    if (!judged) return fail(judged.error());
    note(*judged);
    *file = *std::move(judged);
  }
  return move_away(**file);
}

/// Errors: what may pass. What cannot be read is refused.
Result<HotFolder::Taken> HotFolder::read(const Entry& entry) const {
  Taken taken{.entry = entry, .copy = {}, .reason = {}};
  if (!is_printable_name(entry.name)) {
    taken.reason = "its name has control characters, %, or more than 200 bytes";
  } else if (entry.kind != Entry::Kind::File) {
    taken.reason = fmt::format("it is {}, and only files are taken", entry.what);
  }
  if (entry.kind != Entry::Kind::File) return taken;
  auto copy = files_->copy(entry, parts_.spool, settings_.max_bytes);
  if (copy) {
    taken.copy.emplace(*std::move(copy));
    return taken;
  }
  if (is_passing(copy.error()) || copy.error().code == Errc::NotFound)
    return fail(Errc::Busy, "{}: {}", entry.name, copy.error().what);
  taken.reason = copy.error().what;
  return taken;
}

FolderFile HotFolder::row_of(const Taken& taken) const {
  FolderFile file;
  file.folder = settings_.name;
  file.name = taken.entry.name;
  file.sha256 = taken.copy ? taken.copy->digest() : sha256("");
  file.size = taken.entry.size;
  file.changed_ns = taken.entry.changed_ns;
  file.taken = parts_.sources.clock.now();
  return file;
}

/// The row of this very file, when what becomes of it is decided already.
Result<std::optional<FolderFile>> HotFolder::known(const Taken& taken) {
  auto& store = parts_.sources.store.folders;
  auto before = store.unfinished(settings_.name, taken.entry.name);
  if (!before) return before;
  if (!*before || (*before)->state == FolderFileState::Taken) return std::optional<FolderFile>();
  const FolderFile row = row_of(taken);
  if ((*before)->is_same(row.sha256, row.changed_ns)) return before;
  // That one was moved before a kill; this is another file.
  if (auto moved = store.set_moved((*before)->id, parts_.sources.clock.now()); !moved)
    return fail(moved.error());
  return std::optional<FolderFile>();
}

/// Stored or refused; what it is, is in the store. Errors: what may pass.
Result<FolderFile> HotFolder::judge(const Taken& taken, const std::stop_token& stop) {
  if (!taken.reason.empty()) return refuse(taken, taken.reason);
  const auto named = name(taken);
  if (!named) {
    if (is_passing(named.error())) return fail(named.error());
    return refuse(taken, named.error().what);
  }
  if (auto good = check(*named, *taken.copy, stop); !good) {
    const bool is_ours =
        stop.stop_requested() || good.error().code == Errc::Busy || good.error().code == Errc::Io;
    if (is_ours) return fail(good.error());
    return refuse(taken, good.error().what);
  }
  return store(taken, *named);
}

/// With the control that the program is for: the machine's, or the one that its text shows.
Result<NamedProgram> HotFolder::name(const Taken& taken) const {
  auto named = name_program(settings_, taken.entry.name, taken.copy->owner());
  if (!named) return named;
  if (!named->machine.empty()) {
    const auto machine = parts_.sources.store.machines.find(named->machine);
    if (!machine) return fail(machine.error());
    if (!named->control.empty() && named->control != machine->control) {
      return fail(Errc::Conflict, "machine {} is a {}, and the rule says {}", named->machine,
                  machine->control, named->control);
    }
    named->control = machine->control;
  }
  if (named->control.empty()) {
    const auto head = taken.copy->text().substr(0, library::Programs::kHead);
    auto control = library::detect_control(parts_.catalog, head, named->program);
    if (!control) return fail(control.error());
    named->control = *std::move(control);
  }
  return named;
}

Result<void> HotFolder::check(const NamedProgram& named, const FileCopy& copy,
                              const std::stop_token& stop) const {
  if (!settings_.is_checked) return {};
  const auto verdict = paths::check_text(parts_.sources, {.text = copy.text(),
                                                          .name = named.program,
                                                          .control = named.control,
                                                          .machine = named.machine,
                                                          .stop = stop});
  if (!verdict) return fail(verdict.error());
  if (!*verdict) return {};
  return fail(Errc::Syntax, "{} would not take it: {}",
              named.machine.empty() ? "a " + named.control : "machine " + named.machine, **verdict);
}

Result<FolderFile> HotFolder::store(const Taken& taken, const NamedProgram& named) {
  auto& folders = parts_.sources.store.folders;
  auto file = folders.begin(row_of(taken));
  if (!file) return file;
  const auto revision = upload(named, *taken.copy, file->id);
  if (revision) {
    file->state = FolderFileState::Stored;
    file->program = revision->program;
    file->revision = revision->number;
    return file;
  }
  if (is_passing(revision.error())) return fail(revision.error());
  file->state = FolderFileState::Failed;
  file->reason = revision.error().what.substr(0, kMaxReason);
  if (auto failed = folders.fail_file(file->id, file->reason); !failed) return fail(failed.error());
  return file;
}

Result<storage::Revision> HotFolder::upload(const NamedProgram& named, const FileCopy& copy,
                                            std::uint64_t file) {
  const storage::Actor who(named.author, "folder " + settings_.name);
  const auto begun = parts_.programs.begin({.program = named.program,
                                            .control = named.control,
                                            .comment = named.comment,
                                            .folder_file = file},
                                           who);
  if (!begun) return fail(begun.error());
  for (std::size_t offset = 0; offset < copy.text().size(); offset += kTextPiece) {
    const auto piece = copy.text().substr(offset, kTextPiece);
    if (auto added = parts_.programs.append(begun->id, offset, bytes_of(piece)); !added) {
      (void)parts_.programs.abandon(begun->id);
      return fail(added.error());
    }
  }
  auto committed = parts_.programs.commit(begun->id, copy.digest(), who);
  if (!committed) {
    (void)parts_.programs.abandon(begun->id);
    return fail(committed.error());
  }
  return std::move(committed->revision);
}

Result<FolderFile> HotFolder::refuse(const Taken& taken, const std::string& reason) {
  FolderFile file = row_of(taken);
  file.state = FolderFileState::Failed;
  file.reason = reason.substr(0, kMaxReason);
  return parts_.sources.store.folders.begin(file);
}

/// The target is written down before the file goes there.
Result<void> HotFolder::move_away(const FolderFile& file) {
  auto& store = parts_.sources.store.folders;
  const bool is_failed = file.state == FolderFileState::Failed;
  const auto target =
      files_->free_target(is_failed ? settings_.failed : settings_.done, printable_name(file.name));
  if (!target) return fail(target.error());
  if (auto set = store.set_target(file.id, *target); !set) return set;
  if (is_failed) {
    const std::string line = fmt::format("{}: {}", printable_name(file.name), file.reason);
    if (auto written = files_->write_reason(*target, line); !written) return written;
  }
  if (auto moved = files_->move(file.name, *target); !moved) {
    if (moved.error().code == Errc::NotFound)  // someone took it away: the same as moved
      return store.set_moved(file.id, parts_.sources.clock.now());
    return fail(moved.error().code, "{}: {}", printable_name(file.name), moved.error().what);
  }
  return store.set_moved(file.id, parts_.sources.clock.now());
}

void HotFolder::note(const FolderFile& file) {
  if (file.state == FolderFileState::Stored) {
    process::log_info("folder={} file={} program={} revision={}", settings_.name,
                      printable_name(file.name), file.program, file.revision);
  } else {
    process::log_warning("folder={} file={} refused: {}", settings_.name, printable_name(file.name),
                         file.reason);
    const std::lock_guard lock(mutex_);
    state_.last_refused = printable_name(file.name);
    state_.last_reason = file.reason;
  }
  if (parts_.on_file) parts_.on_file(file);
}

}  // namespace dripline::folders
