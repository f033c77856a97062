#pragma once

#include "clients/cli/context.hpp"

/// One function for each group of verbs: adds it to the application. The verbs run as CLI11
/// callbacks and leave their status in the context, which must outlive the application.
namespace dripline::cli {

void add_program_commands(Command app, Context& context);
void add_machine_commands(Command app, Context& context);
void add_run_commands(Command app, Context& context);
void add_port_commands(Command app, Context& context);
void add_port_transfer_commands(Command group, Context& context);
/// Verbs of `dnc port` that need no server.
void add_port_doctor_command(Command group, Context& context);
void add_port_replay_command(Command group, Context& context);
void add_port_page_command(Command group, Context& context);
void add_setup_commands(Command app, Context& context);
void add_memory_commands(Command app, Context& context);
void add_report_commands(Command app, Context& context);
void add_server_commands(Command app, Context& context);
void add_check_command(Command app, Context& context);
void add_trace_command(Command app, Context& context);
void add_edit_command(Command app, Context& context);
void add_approximate_command(Command app, Context& context);
void add_forecast_command(Command app, Context& context);
void add_graphics_command(Command app, Context& context);
void add_touch_command(Command app, Context& context);
void add_convert_command(Command app, Context& context);
void add_chart_command(Command app, Context& context);
void add_extract_command(Command app, Context& context);
void add_conversational_commands(Command app, Context& context);

}  // namespace dripline::cli
