// SPDX-License-Identifier: BSD-3-Clause
// Contact of whole surfaces: which pairs are found, what they do at rest, where surfaces cross.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "core/error.hpp"
#include "shell/contact/contact.hpp"
#include "support/shells.hpp"
#include "support/surfaces.hpp"

namespace luff::shell {
namespace {

surface::TriangleMesh raised(surface::TriangleMesh mesh, const Vec3& by)
{
  for (Vec3& X : mesh.vertices)
    X += by;
  return mesh;
}

/// Two irregular sheets of different meshes above each other.
std::vector<ContactSheet> two_sheets(double gap)
{
  return {{"lower", test::sheet(1, 1, 5, 5), true},
          {"upper", raised(test::sheet(1, 1, 4, 6), Vec3(0.1, 0, gap)), true}};
}

std::string message(const std::vector<ContactSheet>& sheets, const ContactLaw& law)
{
  try {
    const Contact contact(sheets, law);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

/// A strip of length 1 rolled up to a circle of the given angle.
Eigen::VectorXd rolled(const surface::TriangleMesh& strip, double angle)
{
  Eigen::VectorXd x(3 * strip.n_vertices());
  for (int v = 0; v < strip.n_vertices(); ++v) {
    const Vec3& X = strip.vertices[v];
    x.segment<3>(3 * v) = Vec3(std::sin(angle * X.x()) / angle, X.y(), (1 - std::cos(angle * X.x())) / angle);
  }
  return x;
}

TEST(Contact, GathersExactlyThePairsThatCanComeWithinTheirReach)
{
  const ContactLaw law{.distance = 0.1, .stiffness = 1};
  Contact contact(two_sheets(0.3), law);
  const ContactPieces& pieces = contact.pieces();
  const Eigen::VectorXd x = pieces.reference() + 0.1 * test::random_vector(pieces.reference().size(), 3);
  constexpr double margin = 0.05;
  contact.gather(x, margin);

  std::set<std::array<int, 4>> expected;
  const auto expect_if_near = [&](PairKind kind, const std::array<int, 4>& v) {
    if (std::set<int>(v.begin(), v.end()).size() < 4)
      return;
    const double reach = std::min(law.distance, 0.5 * closest(kind, corners(pieces.reference(), v)).distance);
    if (closest(kind, corners(x, v)).distance < reach + 2 * margin)
      expected.insert(v);
  };
  for (int p = 0; p < pieces.n_vertices(); ++p)
    for (const auto& [a, b, c] : pieces.triangles())
      expect_if_near(PairKind::PointTriangle, {p, a, b, c});
  std::set<std::array<int, 4>> found;
  for (const ContactPair& pair : contact.pairs())
    if (pair.kind == PairKind::PointTriangle) {
      EXPECT_TRUE(found.insert(pair.vertex).second);
    }
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 50U);

  found.clear();
  expected.clear();
  for (std::size_t e = 0; e < pieces.edges().size(); ++e)
    for (std::size_t f = e + 1; f < pieces.edges().size(); ++f)
      expect_if_near(PairKind::EdgeEdge,
                     {pieces.edges()[e][0], pieces.edges()[e][1], pieces.edges()[f][0], pieces.edges()[f][1]});
  for (const ContactPair& pair : contact.pairs())
    if (pair.kind == PairKind::EdgeEdge) {
      EXPECT_TRUE(found.insert(pair.vertex).second);
    }
  EXPECT_EQ(found, expected);
}

TEST(Contact, FindsNoPairWithinASurfaceUnlessAskedTo)
{
  Contact contact(two_sheets(0.3), {.distance = 0.1, .stiffness = 1, .self = false});
  contact.gather(contact.pieces().reference(), 0.5);
  EXPECT_GT(contact.pairs().size(), 100U);
  for (const ContactPair& pair : contact.pairs())
    EXPECT_NE(contact.pieces().surface(pair.vertex[0]), contact.pieces().surface(pair.vertex[3]));
}

TEST(Contact, TakesSeparatePartsOfOneMeshForTwoSurfaces)
{
  const std::vector<ContactSheet> sheets = two_sheets(0.3);
  surface::TriangleMesh both = sheets[0].mesh;
  const int n = both.n_vertices();
  test::append(both, sheets[1].mesh);
  const ContactPieces pieces(std::vector<ContactSheet>{{"both", both, true}});
  for (int v = 0; v < pieces.n_vertices(); ++v)
    EXPECT_EQ(pieces.surface(v), v < n ? 0 : n);
}

TEST(Contact, PushesNothingApartAtRestHoweverFineTheMesh)
{
  for (const double distance : {0.01, 0.1, 0.2}) {
    Contact contact(std::vector<ContactSheet>{{"shell", test::curved_sheet(), true},
                                              {"lid", raised(test::curved_sheet(), {0, 0, 0.05}), true}},
                    {.distance = distance, .stiffness = 1});
    contact.gather(contact.pieces().reference(), 0.05);
    EXPECT_GT(contact.pairs().size(), 100U);
    EXPECT_EQ(contact.energy(contact.pieces().reference()), 0);
  }
}

TEST(Contact, GradientIsThatOfTheEnergyOfTwoCrumpledSheets)
{
  Contact contact(two_sheets(0.3), {.distance = 0.15, .stiffness = 2});
  const Eigen::VectorXd& X = contact.pieces().reference();
  const Eigen::VectorXd x = X + 0.12 * test::random_vector(X.size(), 9);
  contact.gather(x, 0.01);
  ASSERT_GT(contact.report(x).active_pairs, 20);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size());
  contact.add_gradient(x, gradient);
  const Eigen::VectorXd direction = test::random_vector(x.size(), 10);
  constexpr double step = 1e-7;
  const double differences = (contact.energy(x + step * direction) - contact.energy(x - step * direction)) / (2 * step);
  EXPECT_NEAR(gradient.dot(direction), differences, 1e-6 * std::abs(differences));
}

TEST(Contact, StiffnessActsOnDeformableVerticesOnlyAndIsPositive)
{
  std::vector<ContactSheet> sheets = two_sheets(0.3);
  sheets[1].deforms = false;
  Contact contact(sheets, {.distance = 0.15, .stiffness = 2});
  const int n = sheets[0].mesh.n_vertices();
  Eigen::VectorXd x = contact.pieces().reference();
  x.tail(x.size() - 3 * n).array() -= 0.2;
  contact.gather(x, 0.01);
  ASSERT_GT(contact.report(x).active_pairs, 20);
  std::vector<std::vector<int>> groups(1);
  for (int v = 0; v < n; ++v)
    groups[0].push_back(v);
  BlockMatrix K(std::make_shared<BlockPattern>(couple(n, groups)));
  contact.add_stiffness(x, ContactHessian::GaussNewton, K);
  EXPECT_GT(K.dense().norm(), 0);
  EXPECT_LT((K.dense() - K.dense().transpose()).norm(), 1e-12 * K.dense().norm());
  const Eigen::VectorXd u = test::random_vector(3 * n, 4);
  EXPECT_GT(u.dot(K * u), 0);
}

TEST(Contact, StopsASheetThatFallsFastOntoAnother)
{
  std::vector<ContactSheet> sheets = two_sheets(0.3);
  Contact contact(sheets, {.distance = 0.1, .stiffness = 1, .self = false});
  const Eigen::VectorXd& x = contact.pieces().reference();
  Eigen::VectorXd dx = Eigen::VectorXd::Zero(x.size());
  for (int v = sheets[0].mesh.n_vertices(); v < contact.pieces().n_vertices(); ++v)
    dx[3 * v + 2] = -5;
  contact.gather(x, 5);
  const double fraction = contact.safe_fraction(x, dx);
  EXPECT_NEAR(5 * fraction, 0.15, 0.0016);
  contact.gather(x + fraction * dx, 0.2);
  EXPECT_GE(contact.report(x + fraction * dx).smallest_gap, 0.15);
}

TEST(Crossings, AreCountedOnceForEveryEdgeThroughATriangle)
{
  surface::TriangleMesh upright;
  upright.vertices = {{0.31, 0.32, -1}, {0.33, 0.31, 1}, {0.36, 5, 1}};
  upright.triangles = {{0, 1, 2}};
  const std::vector<ContactSheet> sheets{{"floor", test::sheet(1, 1, 1, 1), true}, {"blade", upright, true}};
  const ContactPieces pieces(sheets);
  // The blade's near side goes through the floor; the floor's diagonal and its far edge, or sides, cut the blade.
  EXPECT_GT(crossings(pieces, pieces.reference(), false).count, 1);
  EXPECT_TRUE(pierces(upright.vertices[0], upright.vertices[1], {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}));
  EXPECT_FALSE(pierces({2, 2, -1}, {2, 2, 1}, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}));
  EXPECT_FALSE(pierces({0.2, 0.2, 0}, {0.2, 0.2, 1}, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)})) << "it touches";
}

TEST(Crossings, OfAStripWithItselfAreFoundOnlyWhenItOverlaps)
{
  const surface::TriangleMesh strip = test::sheet(1, 0.2, 24, 4);
  const ContactPieces pieces(std::vector<ContactSheet>{{"strip", strip, true}});
  EXPECT_EQ(crossings(pieces, rolled(strip, 6), true).count, 0);
  EXPECT_GT(crossings(pieces, rolled(strip, 7), true).count, 0);
  EXPECT_EQ(crossings(pieces, rolled(strip, 7), false).count, 0);
}

TEST(Contact, RefusesADistanceThatIsNoLengthOrLargerThanTheMesh)
{
  EXPECT_NE(message(two_sheets(0.3), {.distance = -1, .stiffness = 1}).find("contact.distance = -1"),
            std::string::npos);
  EXPECT_NE(message(two_sheets(0.3), {.distance = 0.1, .stiffness = 0}).find("contact.stiffness = 0"),
            std::string::npos);
  const std::string coarse = message(two_sheets(3), {.distance = 0.5, .stiffness = 1});
  EXPECT_NE(coarse.find("mean edge length"), std::string::npos) << coarse;
  EXPECT_NE(coarse.find("'lower'"), std::string::npos) << coarse;
}

TEST(Contact, RefusesSurfacesThatTouchOrCrossAtTheStart)
{
  const ContactLaw law{.distance = 0.1, .stiffness = 1};
  std::vector<ContactSheet> sheets = two_sheets(0.3);
  sheets[1].mesh.vertices[7] = sheets[0].mesh.vertices[20];
  EXPECT_NE(message(sheets, law).find("touch at the start"), std::string::npos) << message(sheets, law);
  sheets[1].mesh.vertices[7].z() = -0.2;
  EXPECT_NE(message(sheets, law).find("cross each other at the start"), std::string::npos) << message(sheets, law);
}

}  // namespace
}  // namespace luff::shell
