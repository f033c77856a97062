#include "server/library/parameter_numbering.hpp"

#include "gateway/interpreter/dialects/centurion/memory/parameter_text.hpp"

namespace dripline::library {

Result<bool> ParameterNumbering::is_own(const Digest& content) {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = known_.find(content); found != known_.end()) return found->second;
  }
  const auto bytes = store_.read_content(content, 0, interpreter::centurion::kNumberingHead);
  if (!bytes) return fail(bytes.error());
  const bool is_own = interpreter::centurion::has_own_numbering(
      {reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  const std::lock_guard lock(mutex_);
  if (known_.emplace(content, is_own).second) sequence_.push_back(content);
  if (sequence_.size() > kMaxKnown) {
    known_.erase(sequence_.front());
    sequence_.pop_front();
  }
  return is_own;
}

Result<void> ParameterNumbering::check(const storage::Revision& revision) {
  const auto is_own = this->is_own(revision.content);
  if (!is_own) return fail(is_own.error());
  if (!*is_own) return {};
  return fail(Errc::Unsupported,
              "program {} revision {} has parameters in Dripline's own numbers, which a control "
              "takes for others: it is not sent to a machine. Write it with the numbers of the "
              "control's builder (dnc setup export MACHINE --map FILE)",
              revision.program, revision.number);
}

}  // namespace dripline::library
