#include <memory>
#include <nlohmann/json.hpp>

#include "clients/cli/context.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/lib/api_json.hpp"

/// `dnc port send`, `receive`, `confirm-reset` and `stop`: programs into a control's memory and out
/// of it.
namespace dripline::cli {
namespace {

constexpr std::chrono::milliseconds kLook{300};

struct SendCommand {
  std::string port;
  std::vector<std::string> programs;
  bool is_left = false;  ///< alone, once it has begun
};

struct ReceiveCommand {
  std::string port;
  bool is_left = false;
};

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const auto& text : texts) all += (all.empty() ? "" : ", ") + text;
  return all;
}

int say_transfer(Context& context, const client::Transfer& transfer) {
  if (context.wants_json) {
    context.print(json_text(transfer));
  } else if (transfer.state == "sending") {
    context.print(
        fmt::format("Sending {}: {}.\n", joined(transfer.programs), bytes_text(transfer.size)));
  } else if (transfer.state == "completed") {
    context.print(
        fmt::format("Sent {}: {}.\n", joined(transfer.programs), bytes_text(transfer.size)));
  } else {
    context.print(fmt::format("Not all was sent, {} of {}: {}: {}\n", bytes_text(transfer.sent),
                              bytes_text(transfer.size), transfer.state, transfer.reason));
  }
  return transfer.state == "sending" || transfer.state == "completed" ? kExitOk : kExitNo;
}

int send(Context& context, const SendCommand& command) {
  catch_interrupts();
  auto client = context.connect();
  if (!client) return context.status;
  auto begun = client->send_programs(command.port, command.programs);
  if (!begun) return complain(begun.error());
  if (command.is_left) return say_transfer(context, *begun);
  while (wait_unless_interrupted(kLook)) {
    auto port = client->port(command.port);
    if (!port) return complain(port.error());
    if (!port->transfer) {
      return complain(client::Failure{
          client::Failure::Kind::Refused, Errc::NotFound,
          "what became of the transfer is not known: the line's owner began again; see dnc "
          "port recording " +
              command.port});
    }
    if (port->transfer->id != begun->id) {
      return complain(client::Failure{client::Failure::Kind::Refused, Errc::NotFound,
                                      "the transfer is over, and another one began since"});
    }
    if (port->transfer->state != "sending") return say_transfer(context, *port->transfer);
  }
  print_error("dnc: the transfer continues; dnc port stop {} ends it\n", command.port);
  return kExitInterrupted;
}

/// The notes of the line, with their times in front so that texts differ.
std::vector<std::string> notes_of(client::Client& client, const std::string& port) {
  std::string lines;
  const auto fetched = client.recording(port, [&](std::string_view piece) {
    lines += piece;
    return true;
  });
  std::vector<std::string> notes;
  for (std::size_t at = 0; fetched && at < lines.size();) {
    const auto end = std::min(lines.find('\n', at), lines.size());
    if (auto json = client::parse_json(lines.substr(at, end - at))) {
      const auto traffic = client::from_json<client::Traffic>(*json);
      if (traffic && traffic->what == "note") {
        notes.push_back(time_text(traffic->time) + "  " + traffic->text);
      }
    }
    at = end + 1;
  }
  return notes;
}

int receive(Context& context, const ReceiveCommand& command) {
  catch_interrupts();
  auto client = context.connect();
  if (!client) return context.status;
  const auto before = notes_of(*client, command.port);
  if (auto begun = client->receive_program(command.port); !begun) return complain(begun.error());
  context.print(fmt::format("Asking the control on {} for a program, for about two minutes.\n",
                            command.port));
  if (command.is_left) return kExitOk;
  while (wait_unless_interrupted(kLook)) {
    auto port = client->port(command.port);
    if (!port) return complain(port.error());
    if (port->line.phase == "receiving") continue;
    const auto notes = notes_of(*client, command.port);
    for (std::size_t i = std::min(before.size(), notes.size()); i < notes.size(); ++i) {
      context.print(printable(notes[i]) + "\n");
    }
    return kExitOk;
  }
  print_error("dnc: the line still asks; dnc port stop {} ends it\n", command.port);
  return kExitInterrupted;
}

int stop(Context& context, const std::string& port) {
  auto client = context.connect();
  if (!client) return context.status;
  if (auto stopped = client->stop_transfer(port); !stopped) return complain(stopped.error());
  context.print(fmt::format("The transfer on {} is ended.\n", port));
  return kExitOk;
}

int confirm_reset(Context& context, const std::string& port) {
  auto client = context.connect();
  if (!client) return context.status;
  if (auto confirmed = client->confirm_reset(port); !confirmed) return complain(confirmed.error());
  context.print(fmt::format("Confirmed: the control on {} was reset. It gets the next program.\n",
                            printable(port)));
  return kExitOk;
}

void add_confirm_reset(Command group, Context& context) {
  auto command = group.add_subcommand("confirm-reset", "Confirm that the control was reset");
  auto name = std::make_shared<std::string>();
  command.add_option("PORT", *name, "The port").required();
  command.footer(
      "A control that does not ask for its programs may be in the middle of one that was broken "
      "off (an\naborted run, a server or a line that was lost), and would read the next one as its "
      "rest. Until this\nis confirmed no run begins there and no program is sent. Reset the "
      "control first, so that no program\nis active in it.");
  command.callback([&context, name] { context.status = confirm_reset(context, *name); });
}

void add_send(Command group, Context& context) {
  auto command = group.add_subcommand("send", "Send programs to the control's memory, as one text");
  auto options = std::make_shared<SendCommand>();
  command.add_option("PORT", options->port, "The port").required();
  command.add_option("PROGRAM", options->programs, "Program, or NAME@REVISION").required();
  command.add_flag("--no-wait", options->is_left, "Do not wait for the end");
  add_json_flag(command, context);
  command.footer(
      "The control must be ready to receive. One program is sent unchanged. Several are sent one "
      "after the\nother, each from its O line (or with one made from its name), framed once as the "
      "line's settings\nrequire; a control that splits at O numbers stores them as single "
      "programs. No run is created.\n\nExample:\n  dnc port send line-2 O0100 O0200 O0300@4");
  command.callback([&context, options] { context.status = send(context, *options); });
}

void add_receive(Command group, Context& context) {
  auto command = group.add_subcommand("receive", "Request a program from the control (XMODEM)");
  auto options = std::make_shared<ReceiveCommand>();
  command.add_option("PORT", options->port, "The port").required();
  command.add_flag("--no-wait", options->is_left, "Do not wait for it");
  command.footer(
      "Over XMODEM the receiver begins: this makes the server ask while the operator starts to "
      "send. It\nbecomes a revision pending approval, one for each O number where the port "
      "extracts programs. All other\nlines accept what their control sends at any time.");
  command.callback([&context, options] { context.status = receive(context, *options); });
}

}  // namespace

void add_port_transfer_commands(Command group, Context& context) {
  add_send(group, context);
  add_receive(group, context);
  add_confirm_reset(group, context);
  auto command = group.add_subcommand("stop", "Abort a transfer of dnc port send or receive");
  auto name = std::make_shared<std::string>();
  command.add_option("PORT", *name, "The port").required();
  command.callback([&context, name] { context.status = stop(context, *name); });
}

}  // namespace dripline::cli
