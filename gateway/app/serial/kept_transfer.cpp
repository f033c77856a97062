#include "gateway/app/serial/kept_transfer.hpp"

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "protocol/base/durable_file.hpp"

namespace dripline::gateway {
namespace {

using line::TransferState;
using nlohmann::json;

std::string encode(const line::PortTransfer& transfer) {
  const json text{{"id", transfer.id},
                  {"programs", transfer.programs},
                  {"size", transfer.size},
                  {"sent", transfer.sent},
                  {"at_most", transfer.at_most},
                  {"reason", transfer.reason},
                  {"is_over", transfer.state != TransferState::Sending},
                  {"is_aborted", transfer.state == TransferState::Aborted}};
  return text.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::optional<line::PortTransfer> decode(const std::string& text) {
  const json members = json::parse(text, nullptr, false);
  line::PortTransfer transfer;
  try {
    transfer.id = members.at("id").get<std::string>();
    transfer.programs = members.at("programs").get<std::vector<std::string>>();
    transfer.size = members.at("size").get<std::uint64_t>();
    transfer.sent = members.at("sent").get<std::uint64_t>();
    transfer.at_most = members.at("at_most").get<std::uint64_t>();
    transfer.reason = members.at("reason").get<std::string>();
    transfer.state =
        members.at("is_aborted").get<bool>() ? TransferState::Aborted : TransferState::Interrupted;
    if (members.at("is_over").get<bool>()) return transfer;
  } catch (const json::exception&) {
    return std::nullopt;
  }
  transfer.at_most = transfer.size;
  transfer.reason = fmt::format(
      "the gateway stopped; at most {} bytes were sent: the control may have a part of it, delete "
      "that there and send it again",
      transfer.size);
  return transfer;
}

}  // namespace

Result<std::optional<line::PortTransfer>> KeptTransfer::read() const {
  std::error_code failure;
  if (!std::filesystem::exists(file_, failure)) {
    if (!failure) return std::nullopt;
    return fail(Errc::Io, "{}: {}", file_.string(), failure.message());
  }
  std::ostringstream text;
  text << std::ifstream(file_).rdbuf();
  auto transfer = decode(text.str());
  if (transfer) return transfer;
  return fail(
      Errc::Corrupt,
      "{} is damaged: whether the last text to the control went through is not known; reset "
      "the control, then remove the file",
      file_.string());
}

Result<void> KeptTransfer::write(const std::optional<line::PortTransfer>& transfer) const {
  std::error_code failure;
  if (!transfer) {
    const bool was_there = std::filesystem::remove(file_, failure);
    if (was_there) static_cast<void>(sync_folder(file_.parent_path()));
    if (!failure) return {};
    return fail(Errc::Io, "{}: {}", file_.string(), failure.message());
  }
  if (replace_private_file(file_, encode(*transfer))) return {};
  return fail(Errc::Io, "{}: {}", file_.string(), std::generic_category().message(errno));
}

}  // namespace dripline::gateway
