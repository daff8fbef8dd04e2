// Inputs of a measurement that repeats in rounds.
#include "tests/support/eventually.h"
#include "ui/jobs/round_runner.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace blush::TEST_FILE {
namespace {

// Has the same result as inputs of the same value, and records with which it was compared.
struct Work {
    struct Input {
        int value, number;
        std::vector<int>* compared;
        bool has_same_result(const Input& other) const {
            compared->push_back(number);
            return value == other.value;
        }
    };
    using Output = int;
    void begin(const Input& input) { value_ = input.value; }
    bool round(const std::function<bool()>&) { return true; }
    Output output() const { return value_; }
    static bool is_good(Output) { return true; }

private:
    int value_ = 0;
};

// Tables share storage with those of the frame before, not with those of an input that was measured long ago.
TEST(RoundRunner, ComparesAnInputWithTheNewestBefore) {
    std::vector<int> compared;
    RoundRunner<Work> runner;
    int number = 0;
    for (const int value : {1, 1, 1, 2, 2}) runner.measure({value, number++, &compared});
    EXPECT_EQ(compared, (std::vector{0, 1, 2, 3}));
}

TEST(RoundRunner, KeepsItsResultForAnInputThatIsTheSame) {
    std::vector<int> compared;
    RoundRunner<Work> runner;
    runner.measure({7, 0, &compared});
    while (!runner.state().rests) std::this_thread::yield();
    runner.measure({7, 1, &compared});
    EXPECT_TRUE(runner.state().rests);
    EXPECT_EQ(runner.state().output, 7);
}

// A round that lasts until it is not wanted any more.
struct EndlessWork {
    struct Input {
        int value;
        bool has_same_result(const Input& other) const { return value == other.value; }
    };
    using Output = int;
    void begin(const Input& input) { value_ = input.value; }
    bool round(const std::function<bool()>& wanted) {
        while (value_ == 1 && wanted()) std::this_thread::yield();
        return value_ != 1;
    }
    Output output() const { return value_; }
    static bool is_good(Output) { return true; }

private:
    int value_ = 0;
};

TEST(RoundRunner, CancelsARoundForAnotherInput) {
    RoundRunner<EndlessWork> runner;
    runner.measure({1});
    runner.measure({2});
    ASSERT_TRUE(test::eventually([&] { return runner.state().rests; }));
    EXPECT_EQ(runner.state().output, 2);
}

} // namespace
} // namespace blush::TEST_FILE
