#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "clients/lib/api_types.hpp"
#include "clients/lib/client.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"
#include "protocol/base/result.hpp"

namespace dripline::cli {

/// The tools, offsets and variables of a setup as tables; lengths in the setup's own units. Errors:
/// those of parse_control_data.
Result<std::string> setup_tables(const client::Setup& setup, bool has_color);

/// The MOD menu of a TNC, as a setup of its machine fills it.
struct SetupMenu {
  std::vector<interpreter::tnc155::ModFunction> functions;
  std::vector<interpreter::tnc155::UserParameter> parameters;
};

struct SetupMenuRequest {
  std::string control;             ///< of the machine; empty: as the server has it, or by the text
  std::vector<std::string> holds;  ///< programs of the server that the control's memory has
};

/// Nothing where the machine's control has no such menu. Failures: those of the calls; Local
/// (the setup, a program of `holds` that the control cannot keep).
client::Reply<std::optional<SetupMenu>> menu_of(client::Client& client, const client::Setup& setup,
                                                const SetupMenuRequest& request);

/// Two tables: the menu, and the user parameters where there are some.
std::string menu_tables(const SetupMenu& menu, bool has_color);
/// As "mod_functions" and "user_parameters".
void add_menu(const SetupMenu& menu, nlohmann::ordered_json& json);

}  // namespace dripline::cli
