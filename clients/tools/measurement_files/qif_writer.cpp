#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <vector>

#include "clients/tools/charts/text.hpp"
#include "clients/tools/measurement_files/qif.hpp"
#include "protocol/base/digest.hpp"

namespace dripline::measurement_files {
namespace {

using charts::xml_text;
using measurement::Characteristic;
using measurement::Measurement;
using measurement::Verdict;

constexpr std::uint64_t kStandardId = 1, kFirstId = 2;

enum class Quantity : std::uint8_t { Length, Angle };

Result<Quantity> quantity_of(const Characteristic& of) {
  if (of.unit == "mm" || of.unit == "inch") return Quantity::Length;
  if (of.unit == "deg") return Quantity::Angle;
  return fail(Errc::Unsupported, "characteristic {} is in '{}': QIF results take mm, inch and deg",
              of.name, of.unit);
}

struct Key {
  std::string name, unit;
  std::optional<double> nominal, lower, upper;
  auto operator<=>(const Key&) const = default;
};
Key key_of(const Characteristic& of) {
  return {of.name, of.unit, of.nominal, of.lower, of.upper};
}

/// What the first pass finds: the characteristics, and how many workpieces there are.
struct Outline {
  std::map<Key, std::size_t> index;
  std::vector<Characteristic> characteristics;
  std::size_t parts = 0, measurements = 0;
  bool has_inch = false;
  Sha256 digest;  ///< of what identifies the measurements
};

Result<void> add(Outline& outline, const Measurement& m) {
  if (auto known = quantity_of(m.characteristic); !known) return fail(known.error());
  if (!std::isfinite(m.actual)) {
    return fail(Errc::LimitExceeded, "characteristic {}: a value that is not finite",
                m.characteristic.name);
  }
  const auto [found, is_new] =
      outline.index.try_emplace(key_of(m.characteristic), outline.characteristics.size());
  if (is_new) outline.characteristics.push_back(m.characteristic);
  ++outline.measurements;
  outline.has_inch = outline.has_inch || m.characteristic.unit == "inch";
  outline.digest.update(fmt::format("{}/{}/{}/{}/{}/{};", m.machine, m.record.epoch,
                                    m.record.number, m.item, m.characteristic.name, m.actual));
  return {};
}

/// The same measurements give the same document, so its identity follows from them.
std::string identity_of(const Outline& outline) {
  const std::string hex = outline.digest.digest().hex();
  return fmt::format("{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4),
                     hex.substr(16, 4), hex.substr(20, 12));
}

std::string_view element_of(const Characteristic& of) {
  return of.unit == "deg" ? "UserDefinedAngularCharacteristic" : "UserDefinedLinearCharacteristic";
}

/// Inches are named; what has no name is in the file's primary units.
std::string unit_attribute(const Characteristic& of) {
  return of.unit == "inch" ? " linearUnit=\"inch\"" : "";
}

class Writer {
 public:
  Writer(const Outline& outline, const Sink& sink) : outline_(outline), sink_(sink) {}

  Result<void> head() {
    text_ = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<QIFDocument xmlns=\"http://qifstandards.org/xsd/qif3\" versionQIF=\"3.0.0\" "
        "idMax=\"{}\">\n"
        "<QPId>{}</QPId>\n"
        "<StandardsDefinitions n=\"1\"><Standard "
        "id=\"{}\"><Organization><StandardsOrganizationEnum>ISO"
        "</StandardsOrganizationEnum></Organization><Designator>ISO 8015</Designator></Standard>"
        "</StandardsDefinitions>\n",
        id_max(), identity_of(outline_), kStandardId);
    text_ +=
        "<FileUnits><PrimaryUnits><AngularUnit><SIUnitName>radian</SIUnitName><UnitName>deg</"
        "UnitName>"
        "<UnitConversion><Factor>0.017453292519943295</Factor></UnitConversion></AngularUnit>"
        "<LinearUnit><SIUnitName>meter</SIUnitName><UnitName>mm</"
        "UnitName><UnitConversion><Factor>0.001"
        "</Factor></UnitConversion></LinearUnit></PrimaryUnits>";
    if (outline_.has_inch) {
      text_ +=
          "<OtherUnits n=\"1\"><LinearUnit><SIUnitName>meter</SIUnitName><UnitName>inch</UnitName>"
          "<UnitConversion><Factor>0.0254</Factor></UnitConversion></LinearUnit></OtherUnits>";
    }
    text_ += "</FileUnits>\n";
    characteristics();
    text_ += fmt::format("<Results>\n<MeasurementResultsSet n=\"{}\">\n", outline_.parts);
    return flush();
  }

  Result<void> part(const std::vector<Measurement>& measurements) {
    const Measurement& first = measurements.front();
    append("<MeasurementResults id=\"{}\">\n", next_id_++);
    attributes({{"machine", first.machine},
                {"program", first.program},
                {"run", first.run},
                {"part", first.part},
                {"serial", first.serial}});
    append("<MeasuredCharacteristics><CharacteristicMeasurements n=\"{}\">\n", measurements.size());
    Verdict worst = Verdict::Good;
    for (const Measurement& m : measurements) {
      worst = measurement::worse(worst, m.verdict);
      one(m);
    }
    append(
        "</CharacteristicMeasurements></MeasuredCharacteristics>\n"
        "<InspectionStatus><InspectionStatusEnum>{}</InspectionStatusEnum></InspectionStatus>\n"
        "</MeasurementResults>\n",
        status_of(worst, "UNKNOWN"));
    return flush();
  }

  Result<void> tail() {
    text_ += "</MeasurementResultsSet>\n</Results>\n</QIFDocument>\n";
    return flush();
  }

 private:
  template <class... Args>
  void append(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }
  Result<void> flush() {
    auto done = sink_(text_);
    text_.clear();
    return done;
  }

  std::uint64_t count() const { return outline_.characteristics.size(); }
  std::uint64_t definition_id(std::size_t i) const { return kFirstId + i; }
  std::uint64_t nominal_id(std::size_t i) const { return kFirstId + count() + i; }
  std::uint64_t item_id(std::size_t i) const { return kFirstId + 2 * count() + i; }
  std::uint64_t id_max() const {
    return kFirstId + 3 * count() + outline_.parts + outline_.measurements - 1;
  }

  static std::string_view status_of(Verdict verdict, std::string_view unknown) {
    switch (verdict) {
      case Verdict::Good:
        return "PASS";
      case Verdict::Rework:
        return "REWORK";
      case Verdict::Scrap:
        return "FAIL";
      default:
        return unknown;
    }
  }

  void attributes(const std::vector<std::pair<std::string_view, std::string_view>>& all) {
    const auto count = std::ranges::count_if(all, [](const auto& a) { return !a.second.empty(); });
    if (count == 0) return;
    append("<Attributes n=\"{}\">", count);
    for (const auto& [name, value] : all) {
      if (!value.empty()) append("<AttributeStr name=\"{}\" value=\"{}\"/>", name, xml_text(value));
    }
    text_ += "</Attributes>\n";
  }

  void tolerance(const Characteristic& of) {
    if (!of.lower && !of.upper) {
      text_ += "<NonTolerance>MEASURED</NonTolerance>";
      return;
    }
    const std::string unit = unit_attribute(of);
    text_ += "<Tolerance>";
    if (of.upper) append("<MaxValue{}>{}</MaxValue>", unit, decimal_text(*of.upper, of.decimals));
    if (of.lower) append("<MinValue{}>{}</MinValue>", unit, decimal_text(*of.lower, of.decimals));
    text_ += "<DefinedAsLimit>true</DefinedAsLimit></Tolerance>";
  }

  void characteristics() {
    append(
        "<Characteristics>\n<FormalStandardId>{}</FormalStandardId>\n<CharacteristicDefinitions "
        "n=\"{}\">\n",
        kStandardId, count());
    for (std::size_t i = 0; i < count(); ++i) {
      const Characteristic& of = outline_.characteristics[i];
      append("<{0}Definition id=\"{1}\"><Name>{2}</Name>", element_of(of), definition_id(i),
             xml_text(of.name));
      tolerance(of);
      append("<WhatToMeasure>{1}</WhatToMeasure></{0}Definition>\n", element_of(of),
             xml_text(of.name));
    }
    append("</CharacteristicDefinitions>\n<CharacteristicNominals n=\"{}\">\n", count());
    for (std::size_t i = 0; i < count(); ++i) {
      const Characteristic& of = outline_.characteristics[i];
      append(
          "<{0}Nominal "
          "id=\"{1}\"><CharacteristicDefinitionId>{2}</CharacteristicDefinitionId><Name>{3}</Name>",
          element_of(of), nominal_id(i), definition_id(i), xml_text(of.name));
      if (of.nominal) {
        append("<TargetValue{}>{}</TargetValue>", unit_attribute(of),
               decimal_text(*of.nominal, of.decimals));
      }
      append("</{}Nominal>\n", element_of(of));
    }
    append("</CharacteristicNominals>\n<CharacteristicItems n=\"{}\">\n", count());
    for (std::size_t i = 0; i < count(); ++i) {
      const Characteristic& of = outline_.characteristics[i];
      append(
          "<{0}Item "
          "id=\"{1}\"><Name>{2}</Name><CharacteristicNominalId>{3}</CharacteristicNominalId></"
          "{0}Item>\n",
          element_of(of), item_id(i), xml_text(of.name), nominal_id(i));
    }
    text_ += "</CharacteristicItems>\n</Characteristics>\n";
  }

  void one(const Measurement& m) {
    const std::size_t index = outline_.index.at(key_of(m.characteristic));
    append("<{}Measurement id=\"{}\">", element_of(m.characteristic), next_id_++);
    if (!m.tool.empty()) {
      append("<Attributes n=\"1\"><AttributeStr name=\"tool\" value=\"{}\"/></Attributes>",
             xml_text(m.tool));
    }
    append(
        "<Status><CharacteristicStatusEnum>{1}</CharacteristicStatusEnum></Status>"
        "<CharacteristicItemId>{2}</CharacteristicItemId><TimeStamp>{3}</TimeStamp>"
        "<Value{4}>{5}</Value></{0}Measurement>\n",
        element_of(m.characteristic), status_of(m.verdict, "NOT_ANALYZED"), item_id(index),
        to_iso8601(m.time), unit_attribute(m.characteristic),
        decimal_text(m.actual, m.characteristic.decimals));
  }

  const Outline& outline_;
  const Sink& sink_;
  std::string text_;
  std::uint64_t next_id_ = kFirstId + 3 * outline_.characteristics.size();
};

}  // namespace

Result<void> write_qif(MeasurementSource& source, const Sink& sink) {
  Outline outline;
  auto scanned = each_part(source, [&](const std::vector<Measurement>& part) -> Result<void> {
    ++outline.parts;
    for (const Measurement& m : part) {
      if (auto added = add(outline, m); !added) return added;
    }
    return {};
  });
  if (!scanned) return scanned;
  if (outline.measurements == 0)
    return fail(Errc::LimitExceeded, "QIF results without a measurement");
  Writer writer(outline, sink);
  if (auto written = writer.head(); !written) return written;
  auto done =
      each_part(source, [&](const std::vector<Measurement>& part) { return writer.part(part); });
  return done ? writer.tail() : done;
}

}  // namespace dripline::measurement_files
