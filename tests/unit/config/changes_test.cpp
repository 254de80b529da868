// SPDX-License-Identifier: BSD-3-Clause
// What may change in a case when a run goes on.
#include "case_text.hpp"
#include "config/changes.hpp"

namespace luff::config {
namespace {

class Changes : public testing::Test {
 protected:
  Changes() : file(folder.write("case.toml", small_case)), earlier(list_keys(load_case(file))) {}

  /// What is told of a change of the case.
  [[nodiscard]] std::vector<std::string> after(const std::string& from, const std::string& to) const
  {
    const auto changed_file = folder.write("case.toml", changed(small_case, from, to));
    return accept_changes(earlier, load_case(changed_file), changed_file, {});
  }
  [[nodiscard]] std::string refusal(const std::string& from, const std::string& to) const
  {
    try {
      (void)after(from, to);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder;
  std::filesystem::path file;
  std::string earlier;
};

TEST_F(Changes, ThereAreNoneInTheSameCase)
{
  EXPECT_TRUE(accept_changes(earlier, load_case(file), file, {}).empty());
}

TEST_F(Changes, OfTheEndAndOfWhatIsWrittenAreTold)
{
  EXPECT_EQ(after("end = 2.0", "end = 4.0"), std::vector<std::string>{"time.end = 4, and 2 in the checkpoint's run"});
  EXPECT_EQ(after("fields = { every = 0.5 }", "fields = { every = 0.25 }"),
            std::vector<std::string>{"output.fields.every = 0.25, and 0.5 in the checkpoint's run"});
}

TEST_F(Changes, OfWhatIsComputedAreRefusedWithPlaceAndBothValues)
{
  const std::string text = refusal("viscosity = 0.01", "viscosity = 0.02");
  EXPECT_NE(text.find("case.toml:7: fluid.viscosity = 0.02, and 0.01 in the checkpoint's run: only these may change: "
                      "title, time.end, time.step"),
            std::string::npos)
      << text;
}

TEST_F(Changes, OfWhatIsThereAreRefused)
{
  const std::string more = refusal("[output]", "[contact]\ndistance = 0.01\nstiffness = 1.0\n[output]");
  EXPECT_NE(more.find("contact.distance = 0.01, which the checkpoint's run did not have"), std::string::npos) << more;
}

TEST_F(Changes, OnTheCommandLineAreSeenToo)
{
  const Overrides overrides{.sets = {"fluid.density=3"}};
  try {
    (void)accept_changes(earlier, load_case(file, overrides), file, overrides);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--set fluid.density=3: fluid.density = 3"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace luff::config
