#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/views.hpp"

namespace dripline::api {
namespace {

using nlohmann::json;

json fault_json(const std::optional<audit::Fault>& fault) {
  if (!fault) return nullptr;
  return {{"entry", fault->entry}, {"what", fault->what}};
}

json verification_json(const library::AuditChain::Verification& verification) {
  return {{"time", to_iso8601(verification.at)},
          {"entries", verification.entries},
          {"intact", !verification.fault},
          {"fault", fault_json(verification.fault)}};
}

/// `text`: what is to be kept elsewhere.
json checkpoint_json(const library::AuditChain& chain, const audit::Checkpoint& checkpoint) {
  return {{"number", checkpoint.number},
          {"entry", checkpoint.entry},
          {"time", to_iso8601(checkpoint.time)},
          {"sha256", checkpoint.digest.hex()},
          {"text", audit::header_line(chain.header()) + audit::checkpoint_line(checkpoint)}};
}

/// Null: this server has no folder of archives, or they were not checked yet.
json archives_json(const Services& services) {
  if (services.retention == nullptr) return nullptr;
  const auto state = services.retention->archive_check().state();
  if (!state) return nullptr;
  auto faults = json::array();
  for (const auto& fault : state->faults)
    faults.push_back({{"file", fault.file}, {"what", fault.what}});
  return {{"time", to_iso8601(state->at)},
          {"archives", state->archives},
          {"intact", state->faults.empty()},
          {"faults", std::move(faults)}};
}

Response state_response(const Services& services, const library::AuditChain::State& state) {
  const library::AuditChain& chain = services.chain;
  return json_response(
      200,
      {{"archives", archives_json(services)},
       {"verification",
        state.verification ? verification_json(*state.verification) : json(nullptr)},
       {"checkpoint", state.checkpoint ? checkpoint_json(chain, *state.checkpoint) : json(nullptr)},
       {"public_key", chain.header().key.hex()}});
}

Response list_audit(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return list_response("entries", services.audit.entries(page), audit_json);
}

Response show_verification(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return state_response(services, services.chain.state());
}

Response verify(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  const auto state = services.chain.verify();
  if (!state) return error_response(state.error());
  if (services.retention != nullptr) {
    const auto checked = services.retention->archive_check().check();
    if (!checked) return error_response(checked.error());
  }
  return state_response(services, *state);
}

Response export_trail(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  Response response;
  response.content_type = "text/plain; charset=utf-8";
  response.source = services.chain.exported();
  return response;
}

}  // namespace

void add_audit_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/audit", with(services, list_audit));
  router.add("GET", "/api/v1/audit/export", with(services, export_trail));
  router.add("GET", "/api/v1/audit/verification", with(services, show_verification));
  // A thread of its own: every archive is read.
  router.add("POST", "/api/v1/audit/verification", with(services, verify), Waits::ForMachine);
}

}  // namespace dripline::api
