#include "clients/tools/measurement_files/qif.hpp"

#include <gtest/gtest.h>
#include <libxml/parser.h>
#include <libxml/xmlschemas.h>
#include <libxml/xpath.h>
#include <libxml/xpathInternals.h>
#include <cstdlib>
#include <memory>
#include <set>

#include "tests/unit/clients/tools/measurement_files/sample.hpp"

namespace dripline::measurement_files {
namespace {

using measurement::Measurement;

std::string qif(const std::vector<Measurement>& all) {
  ListSource source(all);
  return written([&](const Sink& sink) { return write_qif(source, sink); });
}

class Document {
 public:
  explicit Document(const std::string& text)
      : document_(xmlReadMemory(text.data(), static_cast<int>(text.size()), "test.qif", nullptr,
                                XML_PARSE_NONET)) {}
  ~Document() { xmlFreeDoc(document_); }
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;
  bool is_read() const { return document_ != nullptr; }
  xmlDocPtr get() const { return document_; }

  std::vector<std::string> all(const char* path) const {
    xmlXPathContextPtr context = xmlXPathNewContext(document_);
    xmlXPathRegisterNs(context, reinterpret_cast<const xmlChar*>("q"),
                       reinterpret_cast<const xmlChar*>("http://qifstandards.org/xsd/qif3"));
    xmlXPathObjectPtr found =
        xmlXPathEvalExpression(reinterpret_cast<const xmlChar*>(path), context);
    std::vector<std::string> texts;
    for (int i = 0;
         found != nullptr && found->nodesetval != nullptr && i < found->nodesetval->nodeNr; ++i) {
      xmlChar* text = xmlNodeGetContent(found->nodesetval->nodeTab[i]);
      texts.emplace_back(reinterpret_cast<const char*>(text));
      xmlFree(text);
    }
    xmlXPathFreeObject(found);
    xmlXPathFreeContext(context);
    return texts;
  }

 private:
  xmlDocPtr document_;
};

TEST(Qif, HoldsEveryValueWithItsCharacteristic) {
  const Document document(qif(sample()));
  ASSERT_TRUE(document.is_read());
  EXPECT_EQ(document.all("//q:MeasurementResultsSet/@n"), std::vector<std::string>{"2"});
  EXPECT_EQ(document.all("//q:UserDefinedLinearCharacteristicMeasurement/q:Value"),
            (std::vector<std::string>{"40.0125", "25.30", "-0.0000001"}));
  EXPECT_EQ(document.all("//q:CharacteristicStatusEnum"),
            (std::vector<std::string>{"PASS", "REWORK", "FAIL"}));
  EXPECT_EQ(document.all("//q:InspectionStatusEnum"), (std::vector<std::string>{"REWORK", "FAIL"}));
  EXPECT_EQ(document.all("//q:MaxValue"), (std::vector<std::string>{"40.020", "25.10"}));
  EXPECT_EQ(document.all("//q:MinValue"), std::vector<std::string>{"39.980"});
  EXPECT_EQ(document.all("//q:AttributeStr[@name='serial']/@value")[0],
            "S-0007 <\"\xC3\x9C\">, \xE2\x82\xAC");
}

TEST(Qif, IdsAreUniqueAndReferencesLead) {
  const Document document(qif(sample()));
  const auto ids = document.all("//@id");
  const std::set<std::string> unique(ids.begin(), ids.end());
  EXPECT_EQ(ids.size(), unique.size());
  unsigned long highest = 0;
  for (const auto& id : ids) highest = std::max(highest, std::stoul(id));
  EXPECT_EQ(document.all("/q:QIFDocument/@idMax"),
            std::vector<std::string>{std::to_string(highest)});
  for (const char* path : {"//q:CharacteristicItemId", "//q:CharacteristicNominalId",
                           "//q:CharacteristicDefinitionId", "//q:FormalStandardId"}) {
    for (const auto& id : document.all(path)) EXPECT_TRUE(unique.contains(id)) << path << " " << id;
  }
  for (const char* list : {"MeasurementResultsSet", "CharacteristicMeasurements",
                           "CharacteristicItems", "Attributes"}) {
    const std::string wrong = std::string("//q:") + list + "[@n != count(*)]";
    EXPECT_TRUE(document.all(wrong.c_str()).empty()) << list;
  }
}

TEST(Qif, TheSameMeasurementsAreTheSameDocument) {
  EXPECT_EQ(qif(sample()), qif(sample()));
  auto other = sample();
  other[0].actual = 40;
  EXPECT_NE(qif(sample()).substr(0, 300), qif(other).substr(0, 300));
}

std::vector<Measurement> all_units() {
  auto all = sample();
  all.push_back(all[0]);
  all.back().characteristic = {"Thread", 1.5, 1.498, std::nullopt, "inch", 4};
  all.push_back(all[0]);
  all.back().characteristic = {"Taper", std::nullopt, std::nullopt, std::nullopt, "deg", 2};
  all.back().verdict = measurement::Verdict::Unknown;
  return all;
}

TEST(Qif, RefusesWhatItHasNoWordFor) {
  auto all = sample();
  all[1].characteristic.unit = "N";
  EXPECT_EQ(qif(all), "error: characteristic Length is in 'N': QIF results take mm, inch and deg");
  EXPECT_EQ(qif({}), "error: QIF results without a measurement");
}

// The schema is not ours to ship. DRIPLINE_QIF_SCHEMA names its QIFDocument.xsd (ANSI/DMSC
// QIF 3.0).
TEST(Qif, IsValidByItsSchema) {
  const char* path = std::getenv("DRIPLINE_QIF_SCHEMA");
  if (path == nullptr) GTEST_SKIP() << "DRIPLINE_QIF_SCHEMA is not set";
  const std::unique_ptr<xmlSchemaParserCtxt, void (*)(xmlSchemaParserCtxtPtr)> parser(
      xmlSchemaNewParserCtxt(path), xmlSchemaFreeParserCtxt);
  const std::unique_ptr<xmlSchema, void (*)(xmlSchemaPtr)> schema(xmlSchemaParse(parser.get()),
                                                                  xmlSchemaFree);
  ASSERT_NE(schema, nullptr);
  const std::unique_ptr<xmlSchemaValidCtxt, void (*)(xmlSchemaValidCtxtPtr)> judge(
      xmlSchemaNewValidCtxt(schema.get()), xmlSchemaFreeValidCtxt);
  for (const auto& all : {sample(), all_units()}) {
    const Document document(qif(all));
    ASSERT_TRUE(document.is_read());
    EXPECT_EQ(xmlSchemaValidateDoc(judge.get(), document.get()), 0);
  }
}

}  // namespace
}  // namespace dripline::measurement_files
