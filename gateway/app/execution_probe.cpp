#include "gateway/app/execution_probe.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

namespace dripline::gateway {
namespace {

/// One store that neither the compiler nor a kill can split.
void put(std::uint64_t& word, std::uint64_t value) {
  std::atomic_ref(word).store(value, std::memory_order_release);
}

}  // namespace

Result<ExecutionProbe> ExecutionProbe::open(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  void* mapped = MAP_FAILED;
  if (descriptor >= 0 && ::ftruncate(descriptor, sizeof(Counts)) == 0) {
    mapped = ::mmap(nullptr, sizeof(Counts), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  }
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (mapped == MAP_FAILED) {
    return fail(Errc::Io, "execution_probe {}: {}", file.string(),
                std::error_code(error, std::generic_category()).message());
  }
  return ExecutionProbe(static_cast<Counts*>(mapped));
}

ExecutionProbe::ExecutionProbe(ExecutionProbe&& other) noexcept
    : counts_(std::exchange(other.counts_, nullptr)) {}

ExecutionProbe::~ExecutionProbe() {
  if (counts_ != nullptr) ::munmap(counts_, sizeof(Counts));
}

void ExecutionProbe::reset() {
  if (counts_ == nullptr) return;
  put(counts_->blocks_done, 0);
  put(counts_->outputs_done, 0);
  put(counts_->blocks_begun, 0);
  put(counts_->outputs_begun, 0);
}

void ExecutionProbe::begin(std::uint64_t block, std::uint64_t outputs) {
  if (counts_ == nullptr) return;
  put(counts_->outputs_begun, outputs);
  put(counts_->blocks_begun, block);
}

void ExecutionProbe::finish() {
  if (counts_ == nullptr) return;
  put(counts_->outputs_done, counts_->outputs_begun);
  put(counts_->blocks_done, counts_->blocks_begun);
}

}  // namespace dripline::gateway
