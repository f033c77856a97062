// A ProtoTRAK Plus as a gateway's control: what its later models' files and CAM posts bring.
#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/jog_fixture.hpp"

namespace dripline::gateway {
namespace {

using dds::RunOutcome;
using testing::HasSubstr;

class ProtoTrakShop : public GatewayFixture {
 public:
  ProtoTrakShop() : GatewayFixture(interpreter::kProtoTrakDialect, {}, "max") {}

  /// With cycle start at each of its stops.
  dds::RunEndText run(const std::string& text) {
    push("PT", text);
    const std::size_t before = count(dds::RecordKind::RunEnded);
    EXPECT_TRUE(start("PT").accepted);
    EXPECT_TRUE(run_until([&] {
      if (status && status->execution == dds::Execution::ProgramStopped) (void)panel("cycle-start");
      return count(dds::RecordKind::RunEnded) > before;
    }));
    return dds::decode_run_end(records.back().text).value();
  }
};

// PT-41.
TEST(ProtoTrakGateway, RunsTheTextOfAnMxFileAndRefusesItsOwnForm) {
  ProtoTrakShop shop;
  const auto text = shop.run(
      "%\nPN12 G21 ;\n(PLATE)\nN1 G101 XB0.000A YB0.000A XE40.000A YE0.000A CR0. D6. TC2 F300. T1 "
      ";\nN2 G103 XB40.000A YB0.000A XE50.000A YE10.000A XC40.000A YC10.000A CR- D6. TC2 F300. T1 "
      ";\n%\n");
  EXPECT_EQ(text.outcome, RunOutcome::Completed) << text.reason;
  EXPECT_NEAR(shop.gateway->status().position[0], 47, 1e-6);
  EXPECT_NEAR(shop.gateway->status().position[1], 10, 1e-6);
  const auto own = shop.run("\x01\x02MX2 \x03 7 1 0\n");
  EXPECT_EQ(own.outcome, RunOutcome::Alarmed);
  EXPECT_THAT(own.reason, HasSubstr("(.MX2, .MX3, .PT4): that form is not published"));
}

// PT-19: the manual knows R of circles alone.
TEST(ProtoTrakGateway, MovesNothingForAnArcWithARadius) {
  ProtoTrakShop shop;
  const auto end = shop.run("PN1 G20 ;\nN1 G00 X1. Y0 T1 ;\nN2 G03 X0 Y1. R1. F100 ;\n%\n");
  EXPECT_EQ(end.outcome, RunOutcome::Alarmed);
  EXPECT_THAT(end.reason, HasSubstr("takes no R for an arc"));
  EXPECT_EQ(shop.gateway->status().position[1], 0);
}

}  // namespace
}  // namespace dripline::gateway
