#include "gateway/report/run_journal.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace dripline::report {
namespace {

/// The layout of a slot, in words of 8 bytes.
enum Place : std::size_t {
  kRun = 0,
  kSent = 5,
  kAccepted,
  kExecuted,
  kLine,
  kSequence,
  kOffset,
  kGeneration,  ///< 1, 2, 3 ...; an empty file has none
  kChecksum,
  kPath,  ///< 0 in a file of a version without it
};

/// Detects words of two different generations in one slot, not malice.
template <class Slot>
std::uint64_t checksum_of(const Slot& slot) {
  std::uint64_t sum = 0x9e3779b97f4a7c15ULL;
  for (std::size_t i = 0; i < kChecksum; ++i) {
    sum = (sum ^ slot[i]) * 0xff51afd7ed558ccdULL;
    sum ^= sum >> 32;
  }
  if (slot[kPath] != 0) sum = (sum ^ slot[kPath]) * 0xff51afd7ed558ccdULL;
  return sum;
}

template <class Slot>
bool is_whole(const Slot& slot) {
  return slot[kGeneration] != 0 && slot[kChecksum] == checksum_of(slot);
}

std::string last_error() {
  return std::error_code(errno, std::generic_category()).message();
}

}  // namespace

Result<RunJournal> RunJournal::open(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) return fail(Errc::Io, "run journal {}: {}", file.string(), last_error());
  // The blocks are reserved now: a full disk later would end the process at a store.
  const int reserved = ::posix_fallocate(descriptor, 0, sizeof(Pages));
  void* mapped = MAP_FAILED;
  if (reserved == 0) {
    mapped = ::mmap(nullptr, sizeof(Pages), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  } else {
    errno = reserved;
  }
  const std::string reason = last_error();
  ::close(descriptor);
  if (mapped == MAP_FAILED) return fail(Errc::Io, "run journal {}: {}", file.string(), reason);

  RunJournal journal(static_cast<Pages*>(mapped));
  for (const Slot& slot : *journal.pages_) {
    if (is_whole(slot)) journal.generation_ = std::max(journal.generation_, slot[kGeneration]);
  }
  return journal;
}

RunJournal::RunJournal(RunJournal&& other) noexcept
    : pages_(std::exchange(other.pages_, nullptr)),
      run_(other.run_),
      progress_(other.progress_),
      generation_(other.generation_) {}

RunJournal::~RunJournal() {
  if (pages_ != nullptr) ::munmap(pages_, sizeof(Pages));
}

std::optional<RunJournal::Entry> RunJournal::read() const {
  const Slot* newest = nullptr;
  for (const Slot& slot : *pages_) {
    if (!is_whole(slot)) continue;
    if (newest == nullptr || slot[kGeneration] > (*newest)[kGeneration]) newest = &slot;
  }
  if (newest == nullptr) return std::nullopt;
  char run[kMaxRun + 1] = {};
  std::memcpy(run, newest->data(), kMaxRun);
  if (run[0] == '\0') return std::nullopt;
  const Slot& slot = *newest;
  return Entry{run,
               {slot[kSent], slot[kAccepted], slot[kExecuted], slot[kLine],
                static_cast<std::int64_t>(slot[kSequence]), slot[kOffset], slot[kPath]}};
}

void RunJournal::begin(std::string_view run) {
  run_.fill('\0');
  std::copy_n(run.begin(), std::min(run.size(), kMaxRun), run_.begin());
  progress_ = {};
  store();
}

void RunJournal::write(const Progress& progress) {
  progress_ = progress;
  store();
}

void RunJournal::clear() {
  run_.fill('\0');
  progress_ = {};
  store();
}

void RunJournal::store() {
  Slot next{};
  std::memcpy(next.data(), run_.data(), kMaxRun);
  next[kSent] = progress_.sent;
  next[kAccepted] = progress_.accepted;
  next[kExecuted] = progress_.executed;
  next[kLine] = progress_.line;
  next[kSequence] = static_cast<std::uint64_t>(progress_.sequence);
  next[kOffset] = progress_.offset;
  next[kPath] = progress_.path;
  next[kGeneration] = ++generation_;
  next[kChecksum] = checksum_of(next);
  // The other slot holds the entry before; no store of this one may be reordered across it.
  std::atomic_signal_fence(std::memory_order_seq_cst);
  std::memcpy((*pages_)[generation_ % 2].data(), next.data(), sizeof(Slot));
  std::atomic_signal_fence(std::memory_order_seq_cst);
}

Result<void> RunJournal::sync() {
  if (::msync(pages_, sizeof(Pages), MS_SYNC) != 0)
    return fail(Errc::Io, "run journal: {}", last_error());
  return {};
}

}  // namespace dripline::report
