// Copy-on-write table with stable ids. Copying a Table copies one pointer; tables that share storage are equal without a
// comparison of their records, so that diff(before, after) is cheap.
#pragma once

#include <algorithm>
#include <cassert>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace blush {

// Stable id of a record in a Table<T>; 0 is no record. A table never reuses an id.
template <class T> struct Id {
    uint32_t value = 0;
    explicit operator bool() const { return value != 0; }
    auto operator<=>(const Id&) const = default;
};

template <class T> class Table {
public:
    struct Entry {
        Id<T> id;
        T value;
        bool operator==(const Entry&) const = default;
    };

    // Entries in id order (insertion order).
    const std::vector<Entry>& entries() const {
        static const std::vector<Entry> none;
        return data_ ? data_->entries : none;
    }
    auto begin() const { return entries().begin(); }
    auto end() const { return entries().end(); }
    size_t size() const { return entries().size(); }
    bool empty() const { return size() == 0; }

    // nullptr if absent. O(log n).
    const T* find(Id<T> id) const {
        const auto it = lower_bound(entries(), id);
        return it != end() && it->id == id ? &it->value : nullptr;
    }
    bool contains(Id<T> id) const { return find(id) != nullptr; }

    Id<T> add(T value) {
        Data& d = unshare();
        const Id<T> id{++d.last_id};
        d.entries.push_back({id, std::move(value)});
        return id;
    }
    // Adds a record with a given id (to undo a removal or merge an import). False if the id is 0 or in use.
    bool insert(Id<T> id, T value) {
        if (!id || contains(id)) return false;
        Data& d = unshare();
        d.last_id = std::max(d.last_id, id.value);
        d.entries.insert(lower_bound(d.entries, id), {id, std::move(value)});
        return true;
    }
    // False if absent. Setting an equal value leaves the storage shared.
    bool set(Id<T> id, T value) {
        const T* old = find(id);
        if (!old) return false;
        if (*old == value) return true;
        Data& d = unshare();
        lower_bound(d.entries, id)->value = std::move(value);
        return true;
    }
    bool remove(Id<T> id) {
        if (!contains(id)) return false;
        Data& d = unshare();
        d.entries.erase(lower_bound(d.entries, id));
        return true;
    }

    bool shares_storage(const Table& other) const { return data_ == other.data_; }
    bool operator==(const Table& other) const { return shares_storage(other) || entries() == other.entries(); }

    // Ids of records that were changed, added or removed. O(1) for tables with shared storage.
    static std::vector<Id<T>> changed(const Table& before, const Table& after) {
        std::vector<Id<T>> ids;
        if (before.shares_storage(after)) return ids;
        auto a = before.begin();
        auto b = after.begin();
        while (a != before.end() || b != after.end()) {
            if (b == after.end() || (a != before.end() && a->id < b->id))
                ids.push_back((a++)->id);
            else if (a == before.end() || b->id < a->id)
                ids.push_back((b++)->id);
            else {
                if (!(a->value == b->value)) ids.push_back(a->id);
                ++a;
                ++b;
            }
        }
        return ids;
    }

private:
    struct Data {
        std::vector<Entry> entries;
        uint32_t last_id = 0;
    };

    template <class Entries> static auto lower_bound(Entries& entries, Id<T> id) {
        return std::lower_bound(entries.begin(), entries.end(), id, [](const Entry& e, Id<T> i) { return e.id < i; });
    }
    Data& unshare() {
        if (!data_)
            data_ = std::make_shared<Data>();
        else if (data_.use_count() > 1)
            data_ = std::make_shared<Data>(*data_);
        return *data_;
    }

    std::shared_ptr<Data> data_;
};

} // namespace blush
