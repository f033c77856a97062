#include "gateway/report/motion_journal.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <type_traits>
#include <utility>

namespace dripline::report {
namespace {

constexpr std::uint64_t kLayoutVersion = 1;

}  // namespace

Result<MotionJournal> MotionJournal::open(const std::filesystem::path& file) {
  static_assert(std::is_trivially_copyable_v<Entry>);
  const auto failed = [&file](int error) {
    return fail(Errc::Io, "motion journal {}: {}", file.string(),
                std::generic_category().message(error));
  };
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) return failed(errno);
  // The blocks are reserved now: a full disk later would end the process at a store.
  const int reserved = ::posix_fallocate(descriptor, 0, sizeof(Pages));
  void* mapped = MAP_FAILED;
  if (reserved == 0)
    mapped = ::mmap(nullptr, sizeof(Pages), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  const int error = reserved == 0 ? errno : reserved;
  ::close(descriptor);
  if (mapped == MAP_FAILED) return failed(error);
  MotionJournal journal(static_cast<Pages*>(mapped));
  constexpr std::uint64_t kLayout = kLayoutVersion << 32U | sizeof(Slot);
  if (journal.pages_->layout != kLayout) {
    std::memset(mapped, 0, sizeof(Pages));
    journal.pages_->layout = kLayout;
  }
  for (const Slot& slot : journal.pages_->slots)
    journal.number_ = std::max({journal.number_, slot.before, slot.after});
  return journal;
}

MotionJournal::MotionJournal(MotionJournal&& other) noexcept
    : pages_(std::exchange(other.pages_, nullptr)), number_(other.number_) {}

MotionJournal::~MotionJournal() {
  if (pages_ != nullptr) ::munmap(pages_, sizeof(Pages));
}

void MotionJournal::begin(std::string_view run) {
  pages_->run.fill('\0');
  pages_->base = number_;
  std::atomic_signal_fence(std::memory_order_seq_cst);
  std::copy_n(run.begin(), std::min(run.size(), kMaxRun), pages_->run.begin());
}

void MotionJournal::write(const Entry& entry) {
  Slot& slot = pages_->slots[++number_ % kEntries];
  slot.before = number_;
  std::atomic_signal_fence(std::memory_order_seq_cst);
  slot.entry = entry;
  std::atomic_signal_fence(std::memory_order_seq_cst);
  slot.after = number_;
}

std::vector<MotionJournal::Entry> MotionJournal::read(std::string_view run,
                                                      std::uint64_t executed) const {
  std::vector<Entry> entries;
  const auto end = std::find(pages_->run.begin(), pages_->run.end(), '\0');
  if (run.empty() || std::string_view(pages_->run.begin(), end) != run.substr(0, kMaxRun))
    return entries;
  // The last one may be half written, and then the device has not got it.
  for (std::uint64_t number = number_; number > pages_->base; --number) {
    const Slot& slot = pages_->slots[number % kEntries];
    if (slot.before != number || slot.after != number) {
      if (number == number_) continue;
      return {};
    }
    if (slot.entry.action.origin.block <= executed) break;
    entries.push_back(slot.entry);
  }
  std::reverse(entries.begin(), entries.end());
  return entries;
}

}  // namespace dripline::report
