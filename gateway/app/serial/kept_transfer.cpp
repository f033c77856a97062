#include "gateway/app/serial/kept_transfer.hpp"

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <system_error>

#include "protocol/base/durable_file.hpp"

namespace dripline::gateway {
namespace {

using line::TransferState;
using nlohmann::json;

constexpr const char* kMayBeInText = "may_be_in_text";

std::string encode(const line::LineMemory& memory) {
  json text = json::object();
  if (const auto& transfer = memory.transfer) {
    text = {{"id", transfer->id},
            {"programs", transfer->programs},
            {"size", transfer->size},
            {"sent", transfer->sent},
            {"at_most", transfer->at_most},
            {"reason", transfer->reason},
            {"is_over", transfer->state != TransferState::Sending},
            {"is_aborted", transfer->state == TransferState::Aborted}};
  }
  text[kMayBeInText] = memory.may_be_in_text;
  return text.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

/// Errors: exceptions of the members.
line::PortTransfer transfer_of(const json& members) {
  line::PortTransfer transfer;
  transfer.id = members.at("id").get<std::string>();
  transfer.programs = members.at("programs").get<std::vector<std::string>>();
  transfer.size = members.at("size").get<std::uint64_t>();
  transfer.sent = members.at("sent").get<std::uint64_t>();
  transfer.at_most = members.at("at_most").get<std::uint64_t>();
  transfer.reason = members.at("reason").get<std::string>();
  transfer.state =
      members.at("is_aborted").get<bool>() ? TransferState::Aborted : TransferState::Interrupted;
  if (members.at("is_over").get<bool>()) return transfer;
  transfer.at_most = transfer.size;
  transfer.reason = fmt::format(
      "the gateway stopped; at most {} bytes were sent: the control may have a part of it, delete "
      "that there and send it again",
      transfer.size);
  return transfer;
}

/// A gateway of an older version has kept transfers only.
std::optional<line::LineMemory> decode(const std::string& text) {
  const json members = json::parse(text, nullptr, false);
  line::LineMemory memory;
  try {
    if (members.contains("id")) memory.transfer = transfer_of(members);
    const bool is_cut = memory.transfer && memory.transfer->state == TransferState::Interrupted;
    const bool is_old = memory.transfer && !members.contains(kMayBeInText);
    memory.may_be_in_text = is_old ? is_cut : members.at(kMayBeInText).get<bool>();
  } catch (const json::exception&) {
    return std::nullopt;
  }
  return memory;
}

}  // namespace

Result<line::LineMemory> KeptTransfer::read() const {
  std::error_code failure;
  if (!std::filesystem::exists(file_, failure)) {
    if (!failure) return line::LineMemory{};
    return fail(Errc::Io, "{}: {}", file_.string(), failure.message());
  }
  std::ostringstream text;
  text << std::ifstream(file_).rdbuf();
  if (auto memory = decode(text.str())) return *std::move(memory);
  return fail(
      Errc::Corrupt,
      "{} is damaged: whether the last text to the control went through is not known; reset "
      "the control, then remove the file",
      file_.string());
}

Result<void> KeptTransfer::write(const line::LineMemory& memory) const {
  std::error_code failure;
  if (!memory.transfer && !memory.may_be_in_text) {
    const bool was_there = std::filesystem::remove(file_, failure);
    if (was_there) static_cast<void>(sync_folder(file_.parent_path()));
    if (!failure) return {};
    return fail(Errc::Io, "{}: {}", file_.string(), failure.message());
  }
  if (replace_private_file(file_, encode(memory))) return {};
  return fail(Errc::Io, "{}: {}", file_.string(), std::generic_category().message(errno));
}

}  // namespace dripline::gateway
