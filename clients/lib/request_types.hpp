#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/lib/api_types.hpp"

/// What a caller of client.hpp asks for. Absent and empty members are not sent.
namespace dripline::client {

struct Page {
  std::uint64_t limit = 100;
  std::uint64_t offset = 0;
};

/// New values of fields; what is absent stays, an empty text takes the value away.
struct FieldChange {
  std::optional<std::string> part, operation, material, machine_group, cam_file;
};

struct UploadRequest {
  std::string program;
  /// Empty: the server detects the control; no comment.
  std::string control, comment;
  /// Also replaces a program that is protected.
  bool overrides_protection = false;
  FieldChange fields = {};
};

struct AttachmentRequest {
  std::string program;
  std::optional<std::uint64_t> revision;  ///< absent: it belongs to the program
  std::string name;
  std::string comment;
};

struct AttachmentRange {
  std::string program;
  std::optional<std::uint64_t> revision;
  std::string name;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< > 0
};

/// What listings and searches choose by; empty: all.
struct ProgramChoice {
  std::string part, operation, material, machine_group, control, author, state;

  bool is_empty() const {
    return part.empty() && operation.empty() && material.empty() && machine_group.empty() &&
           control.empty() && author.empty() && state.empty();
  }
};

struct SearchQuery {
  std::string words;
  ProgramChoice choice;
  std::string machine;
  bool with_replaced = false;
  std::uint64_t before = 0, limit = 20;
};

struct CommitRequest {
  std::string sha256;  ///< empty: the server does not compare it
  bool overrides_protection = false;
};

struct Piece {
  std::uint64_t offset = 0;
  std::string_view bytes;  ///< at most Upload::max_piece
  std::function<bool(std::uint64_t sent)> on_sent;
};

struct ContentRange {
  std::string program;
  std::uint64_t revision = 0;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< > 0
};

/// A part of a stored revision, with size and SHA-256 of the whole.
struct Content {
  std::string bytes;
  std::string sha256;
  std::uint64_t revision = 0, size = 0;
};

struct RunRequest {
  std::string machine, program;
  /// nullopt: the latest.
  std::optional<std::uint64_t> revision;
  /// N120, L7 (line), B4096 (byte), T3 (tool), +25 (blocks); empty: the beginning.
  std::string from = {};
  /// On a serial line, with `from`: send or set; empty: the server refuses and names the words.
  std::string head = {};
  /// At a gateway, with `from`: begin or now; empty: the gateway refuses and names what differs.
  std::string memory = {};
  /// At a gateway, with `from`: the pass, from 1, of a block that is executed more than once.
  std::optional<std::uint64_t> pass = {};
  bool is_test = false;  ///< at a gateway: nothing moves
};

/// An empty text matches every run.
struct RunQuery {
  std::string machine, program, state;
  Page page;
};

/// Two revisions, the latest ones unless others are named.
struct ComparisonQuery {
  std::string first, second;
  std::optional<std::uint64_t> first_revision, second_revision;
  std::string by = "text";  ///< or normalized, motion
  std::string machine;      ///< whose setup applies to motion; empty: the controls' defaults
  double tolerance = 0.001;
  unsigned context = 3;
};

/// A revision, the latest one unless another is named.
struct CheckQuery {
  std::string program;
  std::optional<std::uint64_t> revision = {};
  std::string machine = {};  ///< whose setup applies; empty: the control's defaults
};

struct ReportQuery {
  std::string machine, program;
  Page page;
};

/// Texts that are empty match everything; times are ISO 8601.
struct MeasurementQuery {
  std::string machine, run, characteristic, since, until, verdict;
  bool with_superseded = false;
  bool newest_first = false;
  std::uint64_t limit = 100;
  std::string after = {};  ///< `next` of the answer before
};

/// Texts that are empty match everything.
struct OffsetQuery {
  std::string machine, target, state;
  std::uint64_t limit = 100;
};

/// `scope`: program, machine, macro.
struct TemplateAssignment {
  std::string scope, subject, name;
  std::optional<std::uint64_t> version = {};  ///< absent: the newest
};

struct CommandRequest {
  std::string action;
  std::optional<std::string> text, name;
  std::optional<double> value;
  /// When it was asked for; absent: now. What is done at the machine's panel since is not undone.
  std::optional<std::chrono::steady_clock::time_point> asked = {};
};

struct SetupRequest {
  std::string machine, text, comment;
  /// Of a machine that the server does not know yet; else empty.
  std::string control;
  /// The server refuses the text unless this setup is still the newest.
  std::optional<std::uint64_t> base = {};
};

/// What is set from where the axes of a machine are.
struct PositionToSet {
  std::string axis;
  double value = 0;
  std::string unit, offset;                ///< each may be empty
  std::optional<std::uint64_t> tool = {};  ///< none: a datum
};

/// One step of one axis.
struct JogToMake {
  std::string axis;
  double distance = 0;
  std::string unit;                 ///< mm, in; deg or empty of a rotary axis
  std::optional<double> feed = {};  ///< per minute; none: the highest that the gateway takes
  std::string hold;  ///< the word by which it is kept moving (`keep_jog`); empty: a step
};

/// The configuration of a port; saving replaces all of it.
struct PortRequest {
  std::string name, machine, address;
  /// May be empty.
  std::string line_template, rules;
  Settings settings;
  bool enabled = true;
};

struct SignInRequest {
  std::string user, password;
  std::uint64_t hours = 12;
};

struct UserRequest {
  std::string name, role;
  std::vector<std::string> groups;
  std::optional<std::string> password;
};

/// What is absent stays as it is.
struct UserChange {
  std::optional<std::string> role;
  std::optional<std::vector<std::string>> groups;
  std::optional<bool> locked;
};

struct TokenRequest {
  std::string user, name;
  /// Absent: as much as the user, and the token by which it is made, may have.
  std::optional<std::string> role;
  std::optional<std::vector<std::string>> groups;
  std::uint64_t days = 90;
};

}  // namespace dripline::client
