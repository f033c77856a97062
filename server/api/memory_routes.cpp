#include <nlohmann/json.hpp>

#include "server/api/routes.hpp"

namespace dripline::api {
namespace {

using nlohmann::json;

json number_json(const std::optional<double>& number) {
  return number ? json(*number) : json(nullptr);
}

json memory_json(const library::KeptMemory& memory) {
  auto cells = json::array();
  for (const auto& [name, cell] : memory.cells) {
    cells.push_back(
        {{"name", name}, {"value", number_json(cell.value)}, {"setup", number_json(cell.base)}});
  }
  return {{"machine", memory.machine},
          {"run", memory.run},
          {"program", memory.program ? json(*memory.program) : json(nullptr)},
          {"time", to_iso8601(memory.time)},
          {"cells", std::move(cells)}};
}

/// Reads the stored records, so that the gateway need not be connected.
Response list_memories(Services& services, const Request& request) {
  QueryReader query(request);
  const storage::Page page = read_page(query);
  const auto run = query.text("run");
  if (auto good = query.finish(); !good) return error_response(good.error());
  const std::string machine = request.parameter("name");
  if (const auto known = services.machines.machine(machine); !known)
    return error_response(known.error());
  return list_response("memories", services.runs.memories(machine, run, page), memory_json);
}

}  // namespace

void add_memory_routes(Router& router, Services& services) {
  router.add("GET", "/api/v1/machines/{name}/memory", with(services, list_memories));
}

}  // namespace dripline::api
