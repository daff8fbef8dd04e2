#include "scene/cow.h"

#include <gtest/gtest.h>

#include <string>

namespace blush::TEST_FILE {
namespace {

using Names = Table<std::string>;

TEST(Table, CopiesShareStorageUntilOneIsWrittenTo) {
    Names a;
    const Id<std::string> id = a.add("one");
    Names b = a;
    EXPECT_TRUE(a.shares_storage(b));
    b.set(id, "two");
    EXPECT_FALSE(a.shares_storage(b));
    EXPECT_EQ(*a.find(id), "one");
    EXPECT_EQ(*b.find(id), "two");
}

TEST(Table, SettingAnEqualValueKeepsStorageShared) {
    Names a;
    const Id<std::string> id = a.add("one");
    Names b = a;
    EXPECT_TRUE(b.set(id, "one"));
    EXPECT_TRUE(a.shares_storage(b));
}

TEST(Table, IdsAreNeverReused) {
    Names a;
    const Id<std::string> first = a.add("one");
    a.remove(first);
    EXPECT_NE(a.add("two"), first);
    EXPECT_FALSE(a.contains(first));
}

TEST(Table, InsertRefusesTakenIdsAndKeepsOrder) {
    Names a;
    EXPECT_TRUE(a.insert({7}, "seven"));
    EXPECT_TRUE(a.insert({3}, "three"));
    EXPECT_FALSE(a.insert({7}, "again"));
    EXPECT_FALSE(a.insert({0}, "none"));
    EXPECT_EQ(a.entries()[0].id.value, 3u);
    EXPECT_EQ(a.add("next").value, 8u);
}

TEST(Table, ChangedListsNewGoneAndDifferent) {
    Names before;
    const auto kept = before.add("kept"), renamed = before.add("old"), gone = before.add("gone");
    Names after = before;
    after.set(renamed, "new");
    after.remove(gone);
    const auto added = after.add("added");
    EXPECT_EQ(Names::changed(before, after), (std::vector{renamed, gone, added}));
    EXPECT_TRUE(Names::changed(before, before).empty());
    EXPECT_TRUE(after.contains(kept));
}

TEST(Table, WritesToAbsentRecordsAreRefused) {
    Names a;
    EXPECT_FALSE(a.set({5}, "x"));
    EXPECT_FALSE(a.remove({5}));
    EXPECT_EQ(a.find({0}), nullptr);
}

} // namespace
} // namespace blush::TEST_FILE
