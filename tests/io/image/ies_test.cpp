// IES files: all symmetries of the standard, and hostile files.
#include "io/image/ies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <numbers>

namespace blush::TEST_FILE {
namespace {

struct Photometry {
    std::string header = "IESNA:LM-63-1995\n[TEST] none\n", tilt = "TILT=NONE\n";
    std::string multiplier = "1", type = "1", factors = "1 1 100";
    std::string vertical = "0 45 90", horizontal = "0", candela = "100 50 0";

    std::string text() const {
        const auto count = [](const std::string& s) { return 1 + std::count(s.begin(), s.end(), ' '); };
        return header + tilt +
               fmt::format("1 1000 {} {} {} {} 2 0 0 0\n{}\n{}\n{}\n{}\n", multiplier, count(vertical), count(horizontal), type, factors,
                           vertical, horizontal, candela);
    }
    IesPtr read() const {
        Result<IesPtr> p = parse_ies(text());
        EXPECT_TRUE(p) << p.error().text();
        return p ? *p : nullptr;
    }
    std::string problem() const {
        const Result<IesPtr> p = parse_ies(text());
        return p ? "" : p.error().text();
    }
};

TEST(Ies, AnAxiallySymmetricLamp) {
    const IesPtr p = Photometry{}.read();
    ASSERT_TRUE(p);
    EXPECT_EQ(p->type, IesProfile::Type::c);
    EXPECT_EQ(p->peak, 100);
    for (const double turn : {0.0, 77.0, 359.0}) {
        EXPECT_NEAR(candela_at(*p, 0, turn), 100, 1e-9);
        EXPECT_NEAR(candela_at(*p, 22.5, turn), 75, 1e-9) << "linear between the angles";
        EXPECT_EQ(candela_at(*p, 91, turn), 0) << "0 outside them";
    }
    // 2 pi times the integral of 100 (1 - theta / 90 degrees) sin theta.
    EXPECT_NEAR(luminous_flux(*p), 2 * std::numbers::pi * 100 * (1 - 2 / std::numbers::pi), 0.05);
}

TEST(Ies, FactorsMultiply) {
    Photometry file;
    file.multiplier = "2.5";
    file.factors = "0.9 0.5 100";
    EXPECT_NEAR(double(file.read()->peak), 225, 1e-4) << "1995: the second factor has another use";
    file.header = "IESNA91\n[TEST] none\n";
    EXPECT_NEAR(double(file.read()->peak), 112.5, 1e-4);
    file.header = "";
    EXPECT_NEAR(double(file.read()->peak), 112.5, 1e-4) << "1986 begins without a name";
    file.tilt = "TILT=INCLUDE\n1\n3\n0 45 90\n0.8 0.9 1\n";
    EXPECT_NEAR(double(file.read()->peak), 90, 1e-4);
}

// Candela of directions that follow by symmetry.
TEST(Ies, SymmetriesOfTypeC) {
    Photometry quarter;
    quarter.horizontal = "0 45 90";
    quarter.candela = "100 10 0 100 20 0 100 30 0";
    const IesPtr q = quarter.read();
    for (const auto& [h, candela] :
         {std::pair{0, 10}, {45, 20}, {90, 30}, {135, 20}, {180, 10}, {225, 20}, {270, 30}, {315, 20}, {360, 10}})
        EXPECT_NEAR(candela_at(*q, 45, h), candela, 1e-6) << h;

    Photometry half;
    half.horizontal = "0 90 180";
    half.candela = "100 10 0 100 20 0 100 30 0";
    const IesPtr s = half.read();
    for (const auto& [h, candela] : {std::pair{0, 10}, {90, 20}, {180, 30}, {270, 20}, {360, 10}})
        EXPECT_NEAR(candela_at(*s, 45, h), candela, 1e-6) << h;

    Photometry other = half;
    other.horizontal = "90 180 270";
    const IesPtr o = other.read();
    for (const auto& [h, candela] : {std::pair{0, 20}, {90, 10}, {180, 20}, {270, 30}, {360, 20}})
        EXPECT_NEAR(candela_at(*o, 45, h), candela, 1e-6) << h;

    Photometry full;
    full.horizontal = "0 90 180 270 360";
    full.candela = "100 10 0 100 20 0 100 30 0 100 40 0 100 10 0";
    EXPECT_NEAR(candela_at(*full.read(), 45, 315), 25, 1e-6);
    full.horizontal = "0 90 180 270";
    full.candela = "100 10 0 100 20 0 100 30 0 100 40 0";
    EXPECT_NEAR(candela_at(*full.read(), 45, 315), 25, 1e-6) << "around the corner";
}

TEST(Ies, SymmetriesOfTypeB) {
    Photometry file;
    file.type = "2";
    file.vertical = "0 30 60";
    file.horizontal = "0 40";
    file.candela = "100 50 10 60 20 0";
    const IesPtr p = file.read();
    ASSERT_EQ(p->type, IesProfile::Type::b);
    for (const double v : {-30.0, 30.0})
        for (const double h : {-40.0, 40.0}) EXPECT_NEAR(candela_at(*p, v, h), 20, 1e-6);
    EXPECT_EQ(candela_at(*p, 0, 41), 0) << "dark beyond";

    file.vertical = "-60 0 60";
    file.horizontal = "-40 0 40";
    file.candela = "1 2 3 4 5 6 7 8 9";
    EXPECT_NEAR(candela_at(*file.read(), 60, -40), 3, 1e-6);
}

// The same uniform lamp in both types has the flux of its solid angle, and types differ in what their angles mean.
TEST(Ies, TypesBAndCAgreeOnDirections) {
    Photometry b;
    b.type = "2";
    b.vertical = b.horizontal = "-90 90";
    b.candela = "10 10 10 10";
    EXPECT_NEAR(luminous_flux(*b.read()), 10 * 2 * std::numbers::pi, 1e-3) << "the half space ahead";
    Photometry c;
    c.vertical = "0 90";
    c.candela = "10 10";
    EXPECT_NEAR(luminous_flux(*c.read()), 10 * 2 * std::numbers::pi, 1e-3);

    b.vertical = "-90 0 90";
    b.horizontal = "-90 0 90";
    b.candela = "0 0 0 0 90 0 0 0 0"; // falls linearly in either angle
    const IesPtr p = b.read();
    const double a = 30 * std::numbers::pi / 180;
    EXPECT_NEAR(candela_towards(*p, {std::sin(a), 0, -std::cos(a)}), 60, 1e-4) << "to the side: horizontal";
    EXPECT_NEAR(candela_towards(*p, {0, std::sin(a), -std::cos(a)}), 60, 1e-4) << "upwards: vertical";
    EXPECT_NEAR(candela_towards(*p, {std::sin(a), std::cos(a) * std::sin(a), -std::cos(a) * std::cos(a)}), 40, 1e-4);
    EXPECT_EQ(candela_towards(*p, {0, 0, 1}), 0) << "behind";
}

TEST(Ies, LineBreaksDoNotMatter) {
    Photometry file;
    std::string text = file.text();
    for (char& c : text)
        if (c == ' ') c = '\n';
    const size_t tilt = text.find("TILT=");
    text = "IESNA:LM-63-1995\n[TEST]\n" + text.substr(tilt);
    EXPECT_TRUE(parse_ies(text));
    std::string dos = file.text();
    for (size_t at = 0; (at = dos.find('\n', at)) != dos.npos; at += 2) dos.insert(at, 1, '\r');
    EXPECT_TRUE(parse_ies(dos));
    EXPECT_TRUE(parse_ies(file.text() + "\x1a"));
}

TEST(Ies, ErrorsNameTheFault) {
    EXPECT_NE(Result<IesPtr>(parse_ies("")).error().text().find("TILT"), std::string::npos);
    const auto problem = [](auto&& change) {
        Photometry file;
        change(file);
        return file.problem();
    };
    EXPECT_NE(problem([](Photometry& f) { f.type = "3"; }).find("type A"), std::string::npos);
    EXPECT_NE(problem([](Photometry& f) { f.type = "4"; }), "");
    EXPECT_NE(problem([](Photometry& f) { f.tilt = "TILT=other.tlt\n"; }).find("tilt"), std::string::npos);
    EXPECT_NE(problem([](Photometry& f) { f.candela = "100 50"; }).find("ends before"), std::string::npos);
    EXPECT_NE(problem([](Photometry& f) { f.candela = "100 nan 0"; }).find("not a number"), std::string::npos);
    EXPECT_NE(problem([](Photometry& f) { f.candela = "100 1e999 0"; }), "");
    EXPECT_NE(problem([](Photometry& f) { f.multiplier = "1e38"; }).find("not finite"), std::string::npos);
    EXPECT_NE(problem([](Photometry& f) { f.candela = "100 -5 0"; }).find("negative"), std::string::npos);
    EXPECT_NE(problem([](Photometry& f) { f.candela = "0 0 0"; }).find("all candela values are 0"), std::string::npos);
    EXPECT_NE(problem([](Photometry& f) { f.vertical = "0 90 45"; }).find("ascend"), std::string::npos);
    EXPECT_NE(problem([](Photometry& f) { f.vertical = "0 90 270"; }), "");
    EXPECT_NE(problem([](Photometry& f) { f.horizontal = "10 90", f.candela = "1 1 1 1 1 1"; }), "");
    EXPECT_NE(problem([](Photometry& f) { f.horizontal = "0 60", f.candela = "1 1 1 1 1 1"; }), "");
    EXPECT_NE(problem([](Photometry& f) { f.tilt = "TILT=INCLUDE\n1\n2\n0 90\n1\n"; }), "") << "a factor is missing: numbers are shifted";
}

// Counts beyond the size of the file do not allocate memory.
TEST(Ies, CountsAreLimited) {
    const auto with_counts = [](const char* counts) {
        return fmt::format("IESNA:LM-63-1995\nTILT=NONE\n1 1000 1 {} 1 2 0 0 0\n1 1 100\n0\n0\n100\n", counts);
    };
    for (const char* counts : {"2000000000 1", "1 2000000000", "-1 1", "0 0", "1.5 1", "1048576 1048576", "1e18 2", "1000000 1"})
        EXPECT_FALSE(parse_ies(with_counts(counts))) << counts;
}

TEST(Ies, AnyPrefixAndAnyFlippedByteIsReadOrRefused) {
    Photometry file;
    file.tilt = "TILT=INCLUDE\n1\n2\n0 90\n1 0.5\n";
    file.horizontal = "0 90";
    file.candela = "1 2 3 4 5 6";
    const std::string whole = file.text();
    for (size_t n = 0; n + 3 < whole.size(); ++n)
        EXPECT_FALSE(parse_ies(std::string_view(whole).substr(0, n)) && n + 4 < whole.size()) << n;
    for (size_t n = 0; n < whole.size(); ++n)
        for (const char c : {'\0', '9', '-', ' ', 'e', '\xff'}) {
            std::string damaged = whole;
            damaged[n] = c;
            if (const auto p = parse_ies(damaged)) {
                EXPECT_GT((*p)->peak, 0);
                EXPECT_EQ((*p)->candela.size(), (*p)->vertical.size() * (*p)->horizontal.size());
            }
        }
}

TEST(Ies, ShippedFilesAreRead) {
    for (const char* name : {"downlight.ies", "wall_washer.ies"}) {
        const auto p = read_ies(std::filesystem::path(BLUSH_ASSETS) / "ies" / name);
        ASSERT_TRUE(p) << p.error().text();
        EXPECT_GT(luminous_flux(**p), 500) << name;
        EXPECT_LT(luminous_flux(**p), 5000) << name;
    }
    const auto washer = read_ies(std::filesystem::path(BLUSH_ASSETS) / "ies" / "wall_washer.ies");
    EXPECT_GT(candela_towards(**washer, {0, 0.5, -0.8}), 3 * candela_towards(**washer, {0, -0.5, -0.8})) << "towards the wall";
    EXPECT_NEAR(candela_towards(**washer, {0.4, 0.3, -0.8}), candela_towards(**washer, {-0.4, 0.3, -0.8}), 1e-3);
    EXPECT_FALSE(read_ies("/nowhere.ies"));
}

} // namespace
} // namespace blush::TEST_FILE
