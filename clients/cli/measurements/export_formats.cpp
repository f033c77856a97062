#include "clients/cli/measurements/export_formats.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cstdlib>
#include <filesystem>

#include "clients/cli/offline/mapped_file.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/lib/output_file.hpp"
#include "clients/tools/measurement_files/aqdef.hpp"
#include "clients/tools/measurement_files/part_report.hpp"
#include "clients/tools/measurement_files/points.hpp"
#include "clients/tools/measurement_files/qif.hpp"
#include "clients/tools/measurement_files/text_files.hpp"

namespace dripline::cli {
namespace {

using measurement_files::AqdefEncoding;
using measurement_files::MeasurementSource;
using measurement_files::Sink;

constexpr double kBase = 5;  // mm below the lowest point

Result<void> write_points(const MeasurementExport& request, MeasurementSource& source,
                          const Sink& sink) {
  const auto x = measurement_files::parse_point_x(request.x.empty() ? "radius" : request.x);
  if (!x) return fail(x.error());
  const auto found = measurement_files::points_of(source, *x);
  if (!found) return fail(found.error());
  if (request.format == "points") return measurement_files::write_points_csv(*found, sink);
  if (request.format == "dxf") return measurement_files::write_dxf(*found, 0, sink);
  const auto grid = measurement_files::make_height_grid(*found, request.cell.value_or(0));
  if (!grid) return fail(grid.error());
  return measurement_files::write_stl(*grid, request.base.value_or(kBase), sink);
}

Result<void> write(const MeasurementExport& request, MeasurementSource& source, const Sink& sink) {
  const std::string& format = request.format;
  const measurement_files::AqdefProfile profile{request.is_utf8 ? AqdefEncoding::Utf8
                                                                : AqdefEncoding::Windows1252};
  if (format == "dfq") return measurement_files::write_dfq(source, profile, sink);
  if (format == "dfd") return measurement_files::write_dfd(source, profile, sink);
  if (format == "dfx") return measurement_files::write_dfx(source, profile, sink);
  if (format == "qif") return measurement_files::write_qif(source, sink);
  if (format == "measurements") return measurement_files::write_csv(source, sink);
  if (format == "jsonl") return measurement_files::write_json_lines(source, sink);
  if (format == "html" || format == "pdf") {
    const std::string title = request.title.empty() ? "Measurement report" : request.title;
    return measurement_files::write_part_report(source, {title, ""}, sink);
  }
  return write_points(request, source, sink);
}

/// Most formats pass a line at a time: `sink` gets pieces that are worth a system call, and also
/// what was written before a fault.
Result<void> write_in_pieces(const MeasurementExport& request, MeasurementSource& source,
                             const Sink& sink) {
  constexpr std::size_t kPiece = 64 * 1024;
  std::string piece;
  const auto done = write(request, source, [&](std::string_view bytes) -> Result<void> {
    piece += bytes;
    if (piece.size() < kPiece) return {};
    auto passed = sink(piece);
    piece.clear();
    return passed;
  });
  const auto last = sink(piece);
  return done ? last : done;
}

/// The first of the names that is a program on the path.
std::string find_browser() {
  const char* path = std::getenv("PATH");
  for (const char* name :
       {"chromium", "chromium-headless-shell", "chromium-browser", "google-chrome"}) {
    std::string_view folders = path == nullptr ? "/usr/bin" : path;
    while (!folders.empty()) {
      const auto folder = folders.substr(0, folders.find(':'));
      folders.remove_prefix(std::min(folders.size(), folder.size() + 1));
      const std::string program = fmt::format("{}/{}", folder, name);
      if (::access(program.c_str(), X_OK) == 0) return program;
    }
  }
  return {};
}

/// A browser prints the page: it breaks tables and repeats their heads as the style sheet asks for.
Result<void> print_to_pdf(const std::filesystem::path& page, const std::string& pdf) {
  const std::string browser = find_browser();
  if (browser.empty()) {
    return fail(
        Errc::Unsupported,
        "pdf needs chromium, which is not installed; --format html makes the page to print");
  }
  std::vector<std::string> words{browser,
                                 "--headless",
                                 "--no-sandbox",
                                 "--disable-gpu",
                                 "--no-pdf-header-footer",
                                 "--user-data-dir=" + (page.parent_path() / "profile").string(),
                                 "--print-to-pdf=" + std::filesystem::absolute(pdf).string(),
                                 "file://" + page.string()};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  ::posix_spawn_file_actions_init(&quiet);
  ::posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", 1 /* O_WRONLY */, 0);
  ::posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", 1, 0);
  pid_t child = 0;
  const int spawned =
      ::posix_spawn(&child, browser.c_str(), &quiet, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&quiet);
  int status = 1;
  if (spawned == 0) ::waitpid(child, &status, 0);
  if (spawned == 0 && status == 0 && std::filesystem::exists(pdf)) return {};
  return fail(Errc::Io, "{} did not print the page", browser);
}

struct WorkFolder {
  std::string path = (std::filesystem::temp_directory_path() / "dripline-XXXXXX").string();
  WorkFolder() {
    if (::mkdtemp(path.data()) == nullptr) path.clear();
  }
  ~WorkFolder() {
    std::error_code ignored;
    if (!path.empty()) std::filesystem::remove_all(path, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
};

Result<void> export_to(const MeasurementExport& request, MeasurementSource& source,
                       const std::string& path) {
  auto file = client::OutputFile::create(path);
  if (!file) return fail(file.error());
  auto done =
      write_in_pieces(request, source, [&](std::string_view bytes) { return file->write(bytes); });
  return done ? file->commit() : done;
}

Result<void> export_pdf(const MeasurementExport& request, MeasurementSource& source) {
  const WorkFolder folder;
  if (folder.path.empty()) return fail(Errc::Io, "no temporary folder can be made");
  const std::string page = folder.path + "/report.html";
  if (auto done = export_to(request, source, page); !done) return done;
  return print_to_pdf(page, request.output);
}

}  // namespace

const std::vector<std::string>& measurement_formats() {
  static const std::vector<std::string> kFormats{
      "dfq", "dfd", "dfx", "qif", "html", "pdf", "measurements", "jsonl", "points", "dxf", "stl"};
  return kFormats;
}

int export_measurements(Context& context, const MeasurementExport& request) {
  const bool is_stream = request.output.empty() || request.output == "-";
  if (is_stream && request.format == "pdf") {
    return complain(Error{Errc::Syntax, "--format pdf needs a file: -o FILE"});
  }
  const auto source = open_measurements(context, request.choice);
  if (!source) return context.status;
  if (is_stream) {
    StandardOutput output;
    const auto done = write_in_pieces(request, *source,
                                      [&](std::string_view bytes) { return output.write(bytes); });
    if (output.error()) return output.complain();
    return done ? kExitOk : complain(done.error());
  }
  const auto done = request.format == "pdf" ? export_pdf(request, *source)
                                            : export_to(request, *source, request.output);
  return done ? kExitOk : complain(done.error());
}

}  // namespace dripline::cli
