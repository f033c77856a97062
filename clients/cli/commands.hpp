#pragma once

#include "clients/cli/context.hpp"

/// One function for each group of verbs: adds it to the application. The verbs run as CLI11
/// callbacks and leave their status in the context, which must outlive the application.
namespace dripline::cli {

void add_program_commands(CLI::App& app, Context& context);
void add_machine_commands(CLI::App& app, Context& context);
void add_run_commands(CLI::App& app, Context& context);
void add_port_commands(CLI::App& app, Context& context);
void add_port_transfer_commands(CLI::App& group, Context& context);
/// Verbs of `dnc port` that need no server.
void add_port_doctor_command(CLI::App& group, Context& context);
void add_port_replay_command(CLI::App& group, Context& context);
void add_port_page_command(CLI::App& group, Context& context);
void add_setup_commands(CLI::App& app, Context& context);
void add_memory_commands(CLI::App& app, Context& context);
void add_report_commands(CLI::App& app, Context& context);
void add_server_commands(CLI::App& app, Context& context);
void add_check_command(CLI::App& app, Context& context);
void add_trace_command(CLI::App& app, Context& context);
void add_edit_command(CLI::App& app, Context& context);
void add_approximate_command(CLI::App& app, Context& context);
void add_forecast_command(CLI::App& app, Context& context);
void add_graphics_command(CLI::App& app, Context& context);
void add_touch_command(CLI::App& app, Context& context);
void add_convert_command(CLI::App& app, Context& context);
void add_chart_command(CLI::App& app, Context& context);
void add_extract_command(CLI::App& app, Context& context);
void add_conversational_commands(CLI::App& app, Context& context);

}  // namespace dripline::cli
