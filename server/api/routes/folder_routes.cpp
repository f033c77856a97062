#include <nlohmann/json.hpp>

#include "server/api/api.hpp"
#include "server/api/nullable_json.hpp"
#include "server/folders/name_rules.hpp"

namespace dripline::api {

namespace {

using nlohmann::json;

json folder_json(const folders::FolderState& state) {
  return {{"name", state.settings.name},
          {"path", state.settings.path.string()},
          {"machine", text_or_null(state.settings.machine)},
          {"control", text_or_null(state.settings.control)},
          {"fault", text_or_null(state.fault)},
          {"looked", time_or_null(state.looked)},
          {"waiting", state.waiting},
          {"stored", state.counts.stored},
          {"failed", state.counts.failed},
          {"last_refused", text_or_null(state.last_refused)},
          {"last_reason", text_or_null(state.last_reason)}};
}

json file_json(const storage::FolderFile& file) {
  const bool is_stored = file.state == storage::FolderFileState::Stored;
  return {{"folder", file.folder},
          {"name", folders::printable_name(file.name)},
          {"size", file.size},
          {"sha256", file.sha256.hex()},
          {"state", storage::to_string(file.state)},
          {"program", text_or_null(file.program)},
          {"revision", is_stored ? json(file.revision) : json(nullptr)},
          {"reason", text_or_null(file.reason)},
          {"target", text_or_null(file.target)},
          {"taken", to_iso8601(file.taken)},
          {"moved", time_or_null(file.moved)}};
}

Response list_folders(Services& services, const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  auto folders = json::array();
  if (services.folders != nullptr) {
    for (const auto& state : services.folders->states()) folders.push_back(folder_json(state));
  }
  return json_response(200, {{"folders", std::move(folders)}});
}

Response list_files(Services& services, const Request& request) {
  const std::string& name = request.parameter("name");
  QueryReader query(request);
  const storage::Page page = read_page(query);
  if (auto good = query.finish(); !good) return error_response(good.error());
  if (services.folders == nullptr)
    return error_response({Errc::NotFound, fmt::format("folder '{}' is not configured", name)});
  return list_response("files", services.folders->files(name, page), file_json);
}

}  // namespace

void add_folder_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/folders", with(services, list_folders));
  router.add("GET", "/api/v1/folders/{name}/files", with(services, list_files));
}

}  // namespace dripline::api
