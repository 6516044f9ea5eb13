#pragma once
#include <algorithm>
#include <concepts>
#include <filesystem>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include "rules/language/key.h"

namespace espalier::rules {

/// What there is to say of a key besides its name, kind and field.
struct About {
  std::string unit = {};
  Limits limits = {};
  std::string meaning = {};
  std::string greene = {};
  bool required = false;
  std::size_t most = 0;
};

namespace detail {

template <class Stored, class Field>
Datum datumOf(const Field& field) {
  if constexpr (requires { field.has_value(); }) {
    return field ? datumOf<Stored>(*field) : Datum{};
  } else if constexpr (std::same_as<Field, std::filesystem::path>) {
    return field.string();
  } else {
    return static_cast<Stored>(field);
  }
}

template <class Stored, class Field>
void assign(Field& field, const Stored& stored) {
  if constexpr (std::is_arithmetic_v<Field>) {
    field = static_cast<Field>(stored);
  } else {
    field = stored;
  }
}

/// The name of a list's entry; null where its struct has none.
template <class Entry>
auto nameIn(Entry& entry) {
  if constexpr (requires { entry.name; }) {
    return &entry.name;
  } else {
    return static_cast<std::string*>(nullptr);
  }
}

}  // namespace detail

/// Writes down a Table for the struct T. A field is reached through a member pointer, or through a callable
/// that takes auto& and returns a reference. The key's default is what a default T holds.
template <class T>
class TableOf {
 public:
  Table table() const {
    auto copy = table_;
    copy.make = [] { return std::static_pointer_cast<void>(std::make_shared<T>()); };
    return copy;
  }
  std::shared_ptr<const Table> shared() const { return std::make_shared<const Table>(table()); }

  TableOf& header(About about) { return add("espalier", Kind::header, std::move(about)); }
  TableOf& base(About about) { return add("base", Kind::base, std::move(about)); }
  TableOf& regions(About about) { return add("regions", Kind::regions, std::move(about)); }

  template <class A>
  TableOf& flag(std::string n, A a, About s) {
    return field<bool>(n, Kind::flag, a, s);
  }
  template <class A>
  TableOf& whole(std::string n, A a, About s) {
    return field<std::int64_t>(n, Kind::whole, a, s);
  }
  template <class A>
  TableOf& number(std::string n, A a, About s) {
    return field<double>(n, Kind::number, a, s);
  }
  template <class A>
  TableOf& value(std::string n, A a, About s) {
    return field<Value>(n, Kind::value, a, s);
  }
  template <class A>
  TableOf& length(std::string n, A a, About s) {
    return field<Length>(n, Kind::length, a, s);
  }
  template <class A>
  TableOf& distance(std::string n, A a, About s) {
    return field<Distance>(n, Kind::distance, a, s);
  }
  template <class A>
  TableOf& metres(std::string n, A a, About s) {
    return field<double>(n, Kind::metres, a, s);
  }
  template <class A>
  TableOf& colour(std::string n, A a, About s) {
    s.unit = "sRGB";
    s.limits = {0.0, 1.0};
    return field<sim::Colour>(n, Kind::colour, a, s);
  }
  template <class A>
  TableOf& point(std::string n, A a, About s) {
    return field<sim::Vec3>(n, Kind::point, a, s);
  }
  template <class A>
  TableOf& place(std::string n, A a, About s) {
    return field<sim::Vec3>(n, Kind::place, a, s);
  }
  template <class A>
  TableOf& pairs(std::string n, A a, About s) {
    return field<Pairs>(n, Kind::pairs, a, s);
  }
  template <class A>
  TableOf& outline(std::string n, A a, About s) {
    return field<Pairs>(n, Kind::outline, a, s);
  }
  template <class A>
  TableOf& date(std::string n, A a, About s) {
    return field<std::chrono::year_month_day>(n, Kind::date, a, s);
  }
  template <class A>
  TableOf& name(std::string n, A a, About s) {
    return field<std::string>(n, Kind::name, a, s);
  }
  template <class A>
  TableOf& text(std::string n, A a, About s) {
    return field<std::string>(n, Kind::text, a, s);
  }
  template <class A>
  TableOf& file(std::string n, A a, About s) {
    return field<std::string>(n, Kind::file, a, s);
  }
  template <class A>
  TableOf& names(std::string n, A a, About s) {
    return field<std::vector<std::string>>(n, Kind::names, a, s);
  }

  /// At least one of these keys must be there.
  TableOf& oneOf(std::vector<std::string> names) {
    table_.one_of = std::move(names);
    return *this;
  }

  TableOf& wholeRange(std::string name, int T::*low, int T::*high, About about) {
    Key& key = added(std::move(name), Kind::whole_range, std::move(about));
    key.set = [=](void* t, const Datum& d) {
      const auto& range = std::get<WholeRange>(d);
      static_cast<T*>(t)->*low = static_cast<int>(range.low);
      static_cast<T*>(t)->*high = static_cast<int>(range.high);
    };
    key.get = [=](const void* t) -> Datum {
      const auto& s = *static_cast<const T*>(t);
      return WholeRange{s.*low, s.*high};
    };
    return finish(key);
  }

  /// Choices in the order in which they are shown; an optional field may have none.
  template <class E, class A>
  TableOf& choice(std::string name, A access, std::vector<std::pair<std::string, E>> choices, About about) {
    Key& key = added(std::move(name), Kind::choice, std::move(about));
    for (const auto& c : choices) key.choices.push_back(c.first);
    key.set = [=](void* t, const Datum& d) {
      const auto& word = std::get<std::string>(d);
      const auto at =
          std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.first == word; });
      std::invoke(access, *static_cast<T*>(t)) = at->second;
    };
    key.get = [=](const void* t) -> Datum {
      const auto& now = std::invoke(access, *static_cast<const T*>(t));
      const auto at =
          std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.second == now; });
      return at == choices.end() ? Datum{} : Datum{at->first};
    };
    return finish(key);
  }

  /// A field that takes more than an assignment.
  TableOf& custom(std::string name, Kind kind, std::function<void(T&, const Datum&)> set,
                  std::function<Datum(const T&)> get, About about) {
    Key& key = added(std::move(name), kind, std::move(about));
    key.set = [set](void* t, const Datum& d) { set(*static_cast<T*>(t), d); };
    key.get = [get](const void* t) { return get(*static_cast<const T*>(t)); };
    return finish(key);
  }

  /// A section whose keys describe what `access` leads to: another struct, an optional one (made when it is
  /// opened), or T itself (std::identity).
  template <class A>
  TableOf& section(std::string name, A access, std::shared_ptr<const Table> child, About about,
                   std::string shorthand = "") {
    Key& key = added(std::move(name), Kind::section, std::move(about));
    key.child = std::move(child);
    key.shorthand = std::move(shorthand);
    key.open = [access](void* t) -> void* {
      auto& field = std::invoke(access, *static_cast<T*>(t));
      if constexpr (requires { field.has_value(); }) {
        if (!field) field.emplace();
        return &*field;
      } else {
        return &field;
      }
    };
    key.look = [access](const void* t) -> const void* {
      const auto& field = std::invoke(access, *static_cast<const T*>(t));
      if constexpr (requires { field.has_value(); }) {
        return field ? &*field : nullptr;
      } else {
        return &field;
      }
    };
    return *this;
  }

  /// A list of structs, or (Kind::named) a mapping from names to structs that have a `name`.
  template <class Entry>
  TableOf& list(std::string name, Kind kind, std::vector<Entry> T::*member,
                std::shared_ptr<const Table> child, About about, std::string shorthand = "") {
    Key& key = added(std::move(name), kind, std::move(about));
    key.child = std::move(child);
    key.shorthand = std::move(shorthand);
    key.clear = [member](void* t) { (static_cast<T*>(t)->*member).clear(); };
    key.append = [member, kind](void* t, const std::string& item_name) -> void* {
      auto& item = (static_cast<T*>(t)->*member).emplace_back();
      if (auto* const own = detail::nameIn(item); own && kind == Kind::named) *own = item_name;
      return &item;
    };
    key.items = [member, kind](const void* t) {
      std::vector<Item> all;
      for (const auto& entry : static_cast<const T*>(t)->*member) {
        Item item{"", &entry};
        if (const auto* own = detail::nameIn(entry); own && kind == Kind::named) item.name = *own;
        all.push_back(std::move(item));
      }
      return all;
    };
    return *this;
  }

 private:
  Key& added(std::string name, Kind kind, About about) {
    Key key;
    key.name = std::move(name);
    key.kind = kind;
    key.unit = std::move(about.unit);
    key.limits = about.limits;
    key.meaning = std::move(about.meaning);
    key.greene = std::move(about.greene);
    key.required = about.required;
    key.most = about.most;
    return table_.keys.emplace_back(std::move(key));
  }

  TableOf& add(std::string name, Kind kind, About about) {
    added(std::move(name), kind, std::move(about));
    return *this;
  }

  TableOf& finish(Key& key) {
    const T plain{};
    if (!key.required) key.default_value = key.get(&plain);
    return *this;
  }

  template <class Stored, class A>
  TableOf& field(std::string name, Kind kind, A access, About about) {
    Key& key = added(std::move(name), kind, std::move(about));
    key.set = [access](void* t, const Datum& d) {
      detail::assign(std::invoke(access, *static_cast<T*>(t)), std::get<Stored>(d));
    };
    key.get = [access](const void* t) {
      return detail::datumOf<Stored>(std::invoke(access, *static_cast<const T*>(t)));
    };
    return finish(key);
  }

  Table table_;
};

}  // namespace espalier::rules
