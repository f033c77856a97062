#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/clients/dnc_process.hpp"

namespace dripline {
namespace {

using nlohmann::json;
using test_support::Dnc;

// Rows: HD-076 (the datum is set).
class DncTouch : public testing::Test {
 protected:
  Dnc dnc{DNC_PATH};
};

TEST_F(DncTouch, MeasuresABoreAndGivesTheDatum) {
  dnc.write(
      "bore.toml",
      "[probe]\nsurface = [ { cylinder = { center = { X = 12.0, Y = 3.0 }, radius = 18.0 } } ]\n");
  const auto done = dnc({"touch", "circle", "--setup", "bore.toml", "--datum", "50,10", "--json",
                         "X+:10,5,-5", "X-:10,5,-5", "Y+:12,5,-5", "Y-:12,5,-5"});
  ASSERT_EQ(done.status, 0) << done.err;
  const auto measured = json::parse(done.out).at("measured");
  EXPECT_NEAR(measured.at("X").get<double>(), 12, 1e-6);
  EXPECT_NEAR(measured.at("Y").get<double>(), 3, 1e-6);
  EXPECT_NE(json::parse(done.out).at("setup").get<std::string>().find("name = \"datum\""),
            std::string::npos);
}

TEST_F(DncTouch, SaysWhatItCanNotDo) {
  dnc.write("plane.toml", "[probe]\nsurface = [ { axis = \"Z\", at = -3.0 } ]\n");
  EXPECT_EQ(dnc({"touch", "surface", "--setup", "plane.toml", "Z-:1,2,10"}).status, 0);
  const auto far = dnc({"touch", "surface", "--setup", "plane.toml", "Z-:1,2,200"});
  EXPECT_EQ(far.status, 1);
  EXPECT_NE(far.err.find("TOUCH POINT INACCESSIBLE"), std::string::npos) << far.err;
  EXPECT_EQ(dnc({"touch", "corner", "--setup", "plane.toml", "Z-:1,2,10"}).status, 2);
  EXPECT_EQ(dnc({"touch", "surface", "--setup", "plane.toml", "down:1,2,10"}).status, 2);
}

TEST_F(DncTouch, MakesASetupOfAToolStore) {
  dnc.write("tools.h", "0 BEGIN PGM 0 INCH\nT9 SP12 L+1,5000 R+0,2500\n2 END PGM 0 INCH\n");
  const auto done = dnc({"setup", "import", "tools.h"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.out,
            "units = \"mm\"\n\n[[tool]]\nnumber = 9\nlength = 38.1\nradius = 6.35\npocket = 12\n"
            "special = true\n");
  dnc.write("bad.h", "T9 P L+1\n");
  EXPECT_NE(dnc({"setup", "import", "bad.h"}).err.find("bad.h: line 1"), std::string::npos);
}

// HD-238: the touch probe came with software 06.
TEST_F(DncTouch, AsksForAControlWithATouchProbe) {
  const std::string probe = "[probe]\nsurface = [ { axis = \"Z\", at = -3.0 } ]\n[control]\n";
  dnc.write("old.toml", probe + "software = 5\n");
  dnc.write("new.toml", probe + "software = 6\n");
  dnc.write("wrong.toml", probe + "model = \"TNC 355\"\n");
  const auto touch = [&](const char* setup) {
    return dnc({"touch", "surface", "--setup", setup, "Z-:1,2,10"});
  };
  EXPECT_EQ(touch("new.toml").status, 0);
  const auto old = touch("old.toml");
  EXPECT_EQ(old.status, 2);
  EXPECT_EQ(old.out, "");
  EXPECT_NE(old.err.find("old.toml: a TNC 155 A with software 05 has no touch probe functions"),
            std::string::npos)
      << old.err;
  EXPECT_NE(touch("wrong.toml").err.find("wrong.toml: option model"), std::string::npos);
}

// HD-238
TEST_F(DncTouch, ImportsOnlyParametersThatTheControlHas) {
  dnc.write("mp.txt", "MP222: 168\nMP225: 7\n");
  dnc.write("tools.h", "T9 P12 L+1,5 R+0,25\n");
  dnc.write("old.toml", "[control]\nsoftware = 2\n");
  dnc.write("new.toml", "[control]\nsoftware = 3\n");
  EXPECT_EQ(dnc({"setup", "import", "mp.txt"}).out,
            "[control.machine_parameters]\nMP222 = 168\nMP225 = 7\n");
  EXPECT_EQ(dnc({"setup", "import", "mp.txt", "--setup", "new.toml"}).status, 0);
  const auto refused = dnc({"setup", "import", "mp.txt", "--setup", "old.toml"});
  EXPECT_NE(refused.status, 0);
  EXPECT_EQ(refused.out, "");
  EXPECT_NE(refused.err.find("mp.txt: line 2: MP225: a TNC 155 A with software 02 has no machine "
                             "parameters 225 to 234 (from software 03)"),
            std::string::npos)
      << refused.err;
  EXPECT_EQ(dnc({"setup", "import", "tools.h", "--setup", "new.toml"}).status, 0);
  const auto no_store = dnc({"setup", "import", "tools.h", "--setup", "old.toml"});
  EXPECT_NE(no_store.err.find("no central tool store"), std::string::npos) << no_store.err;
  EXPECT_NE(dnc({"setup", "import", "mp.txt", "--setup", "none.toml"}).status, 0);
}

}  // namespace
}  // namespace dripline
