#include "server/api/measurement_files.hpp"

#include <array>

#include "clients/tools/measurement_files/aqdef.hpp"
#include "clients/tools/measurement_files/part_report.hpp"
#include "clients/tools/measurement_files/points.hpp"
#include "clients/tools/measurement_files/qif.hpp"
#include "server/api/measurement_reading.hpp"

namespace dripline::api {
namespace {

using measurement_files::MeasurementSource;
using measurement_files::PointX;
using measurement_files::Sink;

using AqdefWriter = Result<void>(MeasurementSource&, const measurement_files::AqdefProfile&,
                                 const Sink&);
template <AqdefWriter kWrite>
Result<void> write_aqdef(MeasurementSource& source, const Sink& sink, PointX) {
  return kWrite(source, {}, sink);
}
template <AqdefWriter kWrite>
Result<void> write_aqdef_utf8(MeasurementSource& source, const Sink& sink, PointX) {
  return kWrite(source, {.encoding = measurement_files::AqdefEncoding::Utf8}, sink);
}
Result<void> write_html(MeasurementSource& source, const Sink& sink, PointX) {
  return measurement_files::write_part_report(source, {}, sink);
}
Result<void> write_qif(MeasurementSource& source, const Sink& sink, PointX) {
  return measurement_files::write_qif(source, sink);
}
Result<void> write_points(MeasurementSource& source, const Sink& sink, PointX x) {
  const auto found = measurement_files::points_of(source, x);
  return found ? measurement_files::write_points_csv(*found, sink) : fail(found.error());
}
Result<void> write_dxf(MeasurementSource& source, const Sink& sink, PointX x) {
  const auto found = measurement_files::points_of(source, x);
  return found ? measurement_files::write_dxf(*found, 0, sink) : fail(found.error());
}
Result<void> write_stl(MeasurementSource& source, const Sink& sink, PointX x) {
  constexpr double kBase = 5;  // mm below the lowest point, as `dnc report export` has it
  const auto found = measurement_files::points_of(source, x);
  if (!found) return fail(found.error());
  const auto grid = measurement_files::make_height_grid(*found, 0);
  if (!grid) return fail(grid.error());
  return measurement_files::write_stl(*grid, kBase, sink);
}

struct FileFormat {
  std::string_view name, content_type;
  Result<void> (*write)(MeasurementSource& source, const Sink& sink, PointX x);
};

constexpr std::string_view kWindows1252 = "text/plain; charset=windows-1252",
                           kUtf8 = "text/plain; charset=utf-8", kBytes = "application/octet-stream";
constexpr std::array kFormats{
    FileFormat{"dfq", kWindows1252, write_aqdef<measurement_files::write_dfq>},
    FileFormat{"dfd", kWindows1252, write_aqdef<measurement_files::write_dfd>},
    FileFormat{"dfx", kBytes, write_aqdef<measurement_files::write_dfx>},
    FileFormat{"dfq-utf8", kUtf8, write_aqdef_utf8<measurement_files::write_dfq>},
    FileFormat{"dfd-utf8", kUtf8, write_aqdef_utf8<measurement_files::write_dfd>},
    FileFormat{"qif", "application/xml", write_qif},
    FileFormat{"html", "text/html; charset=utf-8", write_html},
    FileFormat{"points", "text/csv; charset=utf-8", write_points},
    FileFormat{"dxf", "application/dxf", write_dxf},
    FileFormat{"stl", "model/stl", write_stl},
};

}  // namespace

Response file_response(storage::MeasurementStore& store, const storage::MeasurementFilter& filter,
                       const std::string& format, const std::string& x) {
  const auto point_x = measurement_files::parse_point_x(x);
  if (!point_x) return error_response(point_x.error());
  const FileFormat* found = nullptr;
  for (const auto& one : kFormats) {
    if (one.name == format) found = &one;
  }
  if (found == nullptr) {
    return error_response(
        {Errc::Unsupported,
         fmt::format("format '{}' is none of json, csv, jsonl, dfq, dfd, dfx, dfq-utf8, dfd-utf8, "
                     "qif, html, points, dxf, stl",
                     format)});
  }
  auto all = all_measurements(store, filter, kMaxInFile);
  if (!all) return error_response(all.error());
  if (all->empty())
    return error_response({Errc::NotFound, "no measurement is there of what was asked for"});
  measurement_files::ListSource source(*std::move(all));
  Response response;
  response.content_type = found->content_type;
  // What others have written is in it: a file to be saved, never a page of this server.
  response.headers.emplace_back("Content-Disposition", "attachment");
  const Sink sink = [&](std::string_view bytes) -> Result<void> {
    response.body += bytes;
    return {};
  };
  const auto done = found->write(source, sink, *point_x);
  return done ? response : error_response(done.error());
}

}  // namespace dripline::api
