#include "gateway/app/memory/control_values.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// CEN-245: what the DIAG, PROG and USER pages of a control show, asked of a running gateway.
namespace dripline::gateway {
namespace {

using nlohmann::json;

class ControlValues : public testing::Test {
 protected:
  json ask(const std::string& beginning, double passed_over = 0) {
    dds::Command query = fixture_.command(dds::CommandAction::Query);
    query.argument = beginning;
    query.value = passed_over;
    const dds::CommandResult result = fixture_.send(query);
    EXPECT_TRUE(result.accepted) << result.reason;
    return json::parse(result.values);
  }
  static json value_of(const json& answer, const std::string& name) {
    for (const json& one : answer["values"])
      if (one["name"] == name) return one["value"];
    return "not there";
  }

  GatewayFixture fixture_{interpreter::kCenturionDialect,
                          *interpreter::parse_setup("units = \"in\"\nstart = { X = 2, Z = 2 }"),
                          "1x"};
};

TEST_F(ControlValues, AreThoseOfTheExecutedBlocksWhileAProgramRuns) {
  fixture_.push("O1",
                "G98\nP10=7.5\nSET X 3\nM0\nP10=9\nP11=1\nCLR X 3\nSET Z 1\nM21\nG1 X1 F1\nM30\n");
  ASSERT_TRUE(fixture_.start("O1").accepted);
  ASSERT_TRUE(fixture_.run_until([&] {
    return fixture_.status && fixture_.status->execution == dds::Execution::ProgramStopped;
  })) << fixture_.status->message;
  json answer = ask("P1");
  EXPECT_EQ(value_of(answer, "P10"), 7.5);
  EXPECT_EQ(value_of(answer, "P11"), 0.0) << "a block that is only read ahead has changed nothing";
  EXPECT_EQ(value_of(answer, "P20"), "not there") << "another beginning";
  EXPECT_EQ(answer["outputs"], json::parse(R"([{"axis":"X","output":3,"on":true}])"));
}

// M62 to M68 and M100 to M199 with their words, as the blocks that are executed have handed them
// on.
TEST(LiveControlValues, OfLinuxCncAreItsOutputsAndItsFunctionsWithTheirWords) {
  auto setup = interpreter::parse_setup("[control]\nprofile = \"linuxcnc\"");
  GatewayFixture fixture(interpreter::kRs274NgcDialect, *setup, "1x");
  fixture.push("O1",
               "G21 M64 P3\nM62 P4\nG0 X1\nM65 P3\nM68 E1 Q2.5\nM67 E0 Q-0.25\nG0 X2\n"
               "M102 P2 Q3.5\nM199\nM0\nM103 P9\nM68 E1 Q9\nM2\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.run_until([&] {
    return fixture.status && fixture.status->execution == dds::Execution::ProgramStopped;
  })) << fixture.status->message;
  dds::Command query = fixture.command(dds::CommandAction::Query);
  const json answer = json::parse(fixture.send(query).values);
  EXPECT_EQ(answer["outputs"], json::parse(R"([{"axis":"X","output":3,"on":false},)"
                                           R"({"axis":"X","output":4,"on":true}])"));
  EXPECT_EQ(answer["analog"],
            json::parse(R"([{"output":0,"value":-0.25},{"output":1,"value":2.5}])"))
      << "of blocks after the stop nothing";
  EXPECT_EQ(answer["functions"],
            json::parse(R"(["M199","M102 P2 Q3.5","M67 E0 Q-0.25","M68 E1 Q2.5"])"));
  EXPECT_EQ(answer["codes"], json::parse("[199,102,67,68]"));
}

// A TNC forgets its Q parameters, and shows them while a program runs.
TEST(LiveControlValues, OfATncAreItsQParameters) {
  GatewayFixture fixture(interpreter::kTnc155Dialect, {}, "1x");
  const auto q = [&](const std::string& name) {
    dds::Command query = fixture.command(dds::CommandAction::Query);
    query.argument = name;
    const json answer = json::parse(fixture.send(query).values);
    EXPECT_TRUE(answer["inputs"].empty()) << "a simulated machine has none";
    return answer["values"].empty() ? json(nullptr) : answer["values"][0]["value"];
  };
  fixture.push("19",
               "0 BEGIN PGM 19 MM\n1 FN 0: Q17 = +7\n2 L X+0 Y+0 R0 F9000\n3 STOP\n"
               "4 FN 1: Q17 = +Q17 + +1\n5 STOP\n6 L X+9 Y+9\n7 END PGM 19 MM\n");
  const auto stops = [&] {
    return fixture.run_until([&] {
      return fixture.status && fixture.status->execution == dds::Execution::ProgramStopped;
    });
  };
  EXPECT_TRUE(q("Q17").is_null()) << "nothing has run";
  ASSERT_TRUE(fixture.start("19").accepted);
  ASSERT_TRUE(stops()) << fixture.status->message;
  EXPECT_EQ(q("Q17"), 7.0) << "the block after the stop is only read ahead";
  ASSERT_TRUE(fixture.send(fixture.command(dds::CommandAction::Resume)).accepted);
  ASSERT_TRUE(fixture.run_until([&] { return q("Q17") == 8.0; }));
  ASSERT_TRUE(fixture.send(fixture.command(dds::CommandAction::Resume)).accepted);
  EXPECT_EQ(fixture.ended().outcome, dds::RunOutcome::Completed);
  EXPECT_EQ(q("Q17"), 8.0) << "of the last program, until the next one begins";
}

/// What a program has set up to its stop, and what it reads ahead is not there yet.
json values_at_stop(const interpreter::Dialect& control, const std::string& setup,
                    const std::string& text, const std::string& beginning = "#") {
  GatewayFixture fixture(control, *interpreter::parse_setup(setup), "1x");
  fixture.push("P", text);
  EXPECT_TRUE(fixture.start("P").accepted);
  EXPECT_TRUE(fixture.run_until([&] {
    return fixture.status && fixture.status->execution == dds::Execution::ProgramStopped;
  })) << fixture.status->message;
  dds::Command query = fixture.command(dds::CommandAction::Query);
  query.argument = beginning;
  json shown = json::object();
  const json answer = json::parse(fixture.send(query).values);
  for (const json& one : answer["values"]) {
    const std::string name = one["name"];
    if (!one["value"].is_null()) shown[name] = one["value"];
  }
  return shown;
}

// With reset_clears_commons, the default, #100 and up are not kept either.
TEST(LiveControlValues, OfAFanucAreItsLocalsAndWhatAResetClears) {
  const json shown = values_at_stop(interpreter::kFanucDialect, "",
                                    "O1\n#1=3.5\n#101=7\n#500=2\nM0\n#101=8\n#102=1\nM30\n");
  EXPECT_EQ(shown.value("#1", 0.0), 3.5) << shown.dump();
  EXPECT_EQ(shown.value("#101", 0.0), 7.0);
  EXPECT_EQ(shown.value("#500", 0.0), 2.0) << "kept";
  EXPECT_FALSE(shown.contains("#102"));
}

TEST(LiveControlValues, OfLinuxCncAreItsNamedParameters) {
  const json shown =
      values_at_stop(interpreter::kRs274NgcDialect, "[control]\nprofile = \"linuxcnc\"\n",
                     "#<_depth> = 1.5\n#<width> = 2\nM0\n#<_depth> = 9\n#<later> = 1\nM2\n", "#<");
  EXPECT_EQ(shown.value("#<_depth>", 0.0), 1.5) << shown.dump();
  EXPECT_EQ(shown.value("#<width>", 0.0), 2.0);
  EXPECT_FALSE(shown.contains("#<later>"));
}

TEST_F(ControlValues, OfALongMemoryComeInPages) {
  fixture_.push("O1", "P10=7.5\nM30\n");
  ASSERT_TRUE(fixture_.start("O1").accepted);
  fixture_.ended();
  std::size_t values = 0;
  json next = 0;
  for (int pages = 0; !next.is_null(); ++pages) {
    ASSERT_LT(pages, 100);
    const json answer = ask("", next.get<double>());
    EXPECT_LE(answer.dump().size(), dds::kMaxCommandSetup);
    values += answer["values"].size();
    next = answer["next"];
  }
  EXPECT_GT(values, 1000U) << "parameters and bytes";
  EXPECT_EQ(value_of(ask("P10"), "P10"), 7.5) << "when the program is over, too";
}

TEST_F(ControlValues, AreThoseOfTheSetupBeforeTheFirstProgramAndChangeNothing) {
  dds::Command query = fixture_.command(dds::CommandAction::Query);
  query.argument = "P10";
  query.setup = "[[variable]]\nname = \"P10\"\nvalue = 2.5\n";
  EXPECT_EQ(value_of(json::parse(fixture_.send(query).values), "P10"), 2.5) << "the server's";
  const json answer = ask("P10");
  EXPECT_EQ(value_of(answer, "P10"), 0);
  EXPECT_TRUE(answer["outputs"].empty());
  EXPECT_TRUE(answer["next"].is_null());
  EXPECT_EQ(fixture_.status->execution, dds::Execution::Ready);
}

TEST_F(ControlValues, AreAnsweredAgainUnderTheSameIdAsTheyAreThen) {
  dds::Command query = fixture_.command(dds::CommandAction::Query);
  query.argument = "P10";
  EXPECT_EQ(value_of(json::parse(fixture_.send(query).values), "P10"), 0);
  fixture_.push("O1", "P10=7.5\nM30\n");
  ASSERT_TRUE(fixture_.start("O1").accepted);
  fixture_.ended();
  fixture_.results.erase(query.id);
  EXPECT_EQ(value_of(json::parse(fixture_.send(query).values), "P10"), 7.5) << "no answer is kept";
}

}  // namespace
}  // namespace dripline::gateway
