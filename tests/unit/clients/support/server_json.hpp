#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

namespace dripline::test_support {

/// Things as the server's README describes them.
nlohmann::json machine_json(const std::string& name);
nlohmann::json run_json(const std::string& id, const std::string& state);

/// Its newest setup, number 4.
nlohmann::json setup_json(const std::string& machine, const std::string& text);

/// An open line with nothing on it.
nlohmann::json port_json(const std::string& name);

/// A revision of a program. Revisions are distinguished by `program`; as the program's newest one
/// its name is `name`.
nlohmann::json revision_json(const std::string& program, const std::string& name_key,
                             std::uint64_t number, const std::string& content);

}  // namespace dripline::test_support
