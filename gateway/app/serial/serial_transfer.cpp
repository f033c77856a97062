#include "gateway/app/serial/serial_transfer.hpp"

#include <fmt/ranges.h>
#include <utility>

#include "gateway/line/port_transfer.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {
Result<void> SerialTransfer::add(const std::string& id, std::uint64_t offset,
                                 std::string_view piece) {
  const SteadyTime now = parts_.clock.steady_now();
  if (id != id_ && !id_.empty() && now < until_)
    return fail(Errc::Busy, "the text of another transfer is just coming");
  if (id != id_) {
    id_ = id;
    text_.clear();
  }
  until_ = now + kPatience;
  if (offset > text_.size())
    return fail(Errc::Conflict, "text from byte {} on; {} are here", offset, text_.size());
  if (offset + piece.size() > kMaxBytes) {
    return fail(Errc::LimitExceeded, "more than {} bytes: a gateway keeps a whole transfer",
                kMaxBytes);
  }
  const std::size_t known = text_.size() - static_cast<std::size_t>(offset);
  if (known < piece.size()) text_ += piece.substr(known);
  return {};
}

Result<std::string> SerialTransfer::take(const std::string& id, const line::TransferOrder& order) {
  if (id != id_ || text_.empty())
    return fail(Errc::NotFound, "the text of this transfer is not here");
  std::string text = std::exchange(text_, {});
  id_.clear();
  if (sha256(text).hex() != order.content)
    return fail(Errc::Corrupt, "the text is not what the server states");
  return text;
}

void SerialTransfer::send(const std::string& id, const line::TransferOrder& order,
                          const line::PortLine::Answer& answer) {
  auto text = take(id, order);
  if (!text) return answer(fail(text.error()));
  if (auto allowed = parts_.check_allowed(); !allowed) return answer(allowed);
  line::SendJob job;
  job.kind = line::JobKind::Transfer;
  job.id = id;
  job.name = order.name;
  job.programs = order.programs;
  job.size = text->size();
  job.source = std::make_shared<line::KeptText>(*std::move(text));
  process::log_info("programs sent without a run id={} {}", id, fmt::join(order.programs, ", "));
  line::send_programs(*port_, std::move(job), answer);
}

}  // namespace dripline::gateway
