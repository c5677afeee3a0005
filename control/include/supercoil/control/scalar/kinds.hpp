// Lists of the kinds to choose from (laws, estimators), each with its definition and settings.
#pragma once

#include <string_view>
#include <tuple>
#include <variant>

#include "supercoil/control/scalar/arithmetic.hpp"
#include "supercoil/control/scalar/scalar.hpp"

namespace supercoil::control {

/// An entry of a list; a list is a std::tuple of entries. Definition: states a name, whether the
/// kind runs in fixed_point, and In<Scalar>, the class that runs. Member: the kind's own settings
/// within the common ones.
template <class Kind, Kind Value, class TheDefinition, auto Member>
struct Listed {
  using Definition = TheDefinition;
  static constexpr Kind kind = Value;
  static constexpr auto settings = Member;
};

/// Calls function(Listed) for the kind, if it is in the list.
template <class List, class Kind, class Function>
constexpr void with_listed(Kind kind, Function function) {
  const auto call = [&](auto listed) {
    if (kind == decltype(listed)::kind) function(listed);
  };
  std::apply([&](auto... listed) { (call(listed), ...); }, List{});
}

/// Calls function(Definition, its own settings) for the kind that the settings choose, if it is in
/// the list.
template <class List, class Settings, class Function>
constexpr void with_chosen(Settings& settings, Function function) {
  with_listed<List>(settings.kind, [&](auto listed) {
    function(typename decltype(listed)::Definition{}, settings.*decltype(listed)::settings);
  });
}

/// Calls function(Definition, Scalar, its own settings) for the kind and the arithmetic that the
/// settings choose, if the kind is in the list and runs in that arithmetic.
template <class List, class Settings, class Function>
constexpr void with_running(const Settings& settings, Function function) {
  with_chosen<List>(settings, [&](auto definition, const auto& own) {
    switch (settings.arithmetic) {
      case Arithmetic::float32:
        return function(definition, float{}, own);
      case Arithmetic::q8_24:
        if constexpr (decltype(definition)::fixed_point) function(definition, Q8_24{}, own);
        return;
      case Arithmetic::float64:
        return function(definition, double{}, own);
    }
  });
}

/// Calls function(Definition, its own settings) for each entry of the list.
template <class List, class Settings, class Function>
constexpr void with_each(Settings& settings, Function function) {
  const auto call = [&](auto listed) {
    function(typename decltype(listed)::Definition{}, settings.*decltype(listed)::settings);
  };
  std::apply([&](auto... listed) { (call(listed), ...); }, List{});
}

/// The names of the list's kinds, after the one kind that is not in the list.
template <class List, class Kind>
constexpr auto names_of(std::string_view none, Kind none_kind) {
  return std::apply(
      [&](auto... listed) {
        return Names<Kind, 1 + sizeof...(listed)>{
            {{none, none_kind}, {decltype(listed)::Definition::name, decltype(listed)::kind}...}};
      },
      List{});
}

/// False for q8.24 when the kind needs float or double. A kind not in the list runs in all.
template <class List, class Kind>
constexpr bool runs_in(Kind kind, Arithmetic arithmetic) {
  bool fixed_point = true;
  with_listed<List>(kind,
                    [&](auto listed) { fixed_point = decltype(listed)::Definition::fixed_point; });
  return fixed_point || arithmetic != Arithmetic::q8_24;
}

/// A std::variant of None and, for each entry of the list, of Running<Definition, Scalar> in each
/// scalar that the entry runs in.
template <class None, template <class, class> class Running, class List>
class VariantOf {
  template <class Definition, bool FixedPoint = Definition::fixed_point>
  struct Each {
    using All = std::variant<Running<Definition, double>, Running<Definition, float>>;
  };
  template <class Definition>
  struct Each<Definition, true> {
    using All = std::variant<Running<Definition, double>, Running<Definition, float>,
                             Running<Definition, Q8_24>>;
  };
  template <class... Variants>
  struct Joined;
  template <class... Types>
  struct Joined<std::variant<Types...>> {
    using All = std::variant<Types...>;
  };
  template <class... Types, class... More, class... Rest>
  struct Joined<std::variant<Types...>, std::variant<More...>, Rest...>
      : Joined<std::variant<Types..., More...>, Rest...> {};
  template <class TheList>
  struct Of;
  template <class... Entries>
  struct Of<std::tuple<Entries...>>
      : Joined<std::variant<None>, typename Each<typename Entries::Definition>::All...> {};

 public:
  using Type = typename Of<List>::All;
};

}  // namespace supercoil::control
