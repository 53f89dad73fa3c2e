// Tables 6.1 to 6.4 of Kurdej's thesis: by its printed equations and as they are meant. What it
// prints itself is known to the page.
#include <array>
#include <string_view>
#include <vector>

#include "lab/experiments/experiments.hpp"
#include "lab/reference/evidential/discounting.hpp"
#include "lab/reference/evidential/temporal_discounting.hpp"

namespace iog::lab {
namespace {

using reference::evidential::contextual_rates;
using reference::evidential::decay_rates;
using reference::evidential::discounted;
using reference::evidential::discounted_as_printed;
using reference::evidential::discounted_contextually;
using reference::evidential::left_after;
using reference::evidential::MassFunction;
using reference::evidential::Rate;
using reference::evidential::Rates;
using reference::evidential::Scheme;
using reference::evidential::Set;

constexpr int kElements = 3;
// By set: bit 0 is the first element.
constexpr std::array<std::string_view, 8> kSetNames{"empty", "1",  "2",  "12",
                                                    "3",     "13", "23", "frame"};

struct NamedScheme {
  std::string_view name;
  Scheme scheme;
};
constexpr std::array kNamedSchemes{NamedScheme{"optimistic", Scheme::kOptimistic},
                                   NamedScheme{"proportional", Scheme::kProportional},
                                   NamedScheme{"conservative", Scheme::kConservative}};

void add_sets(std::string_view of_table, std::string_view scheme, std::string_view reading,
              const MassFunction& mass, Table& table) {
  for (Set a = 0; a <= mass.frame(); ++a) {
    table.row(of_table, scheme, reading, kSetNames[a], mass[a]);
  }
}

void add_schemes(std::string_view of_table, std::string_view reading, const MassFunction& mass,
                 Rates rates, Table& table) {
  for (const NamedScheme& named : kNamedSchemes) {
    add_sets(of_table, named.name, reading, discounted(mass, named.scheme, rates), table);
  }
}

void add_schemes_as_printed(std::string_view of_table, std::string_view reading,
                            const MassFunction& mass, Rates rates, Table& table) {
  for (const NamedScheme& named : kNamedSchemes) {
    add_sets(of_table, named.name, reading, discounted_as_printed(mass, named.scheme, rates),
             table);
  }
}

// Table 6.1 at alpha 0.3 of the first element and 0.2 of the other two, an eighth on every set.
void add_comparison(Table& table) {
  MassFunction even = MassFunction::empty(kElements);
  for (Set a = 0; a <= even.frame(); ++a) {
    even[a] = 1.0 / 8;
  }
  const std::array rates{Rate{1, 0.3}, Rate{6, 0.2}};
  add_schemes("6.1", "meant", even, rates, table);
  add_schemes_as_printed("6.1", "printed equations", even, rates, table);
}

// Table 6.2: aeroplane, helicopter, rocket; the last two with a rate of 0.4.
void add_targets(Table& table) {
  const MassFunction mass(kElements, {{1, 0.5}, {4, 0.5}});
  const std::array rates{Rate{6, 0.4}};
  add_schemes("6.2", "meant", mass, rates, table);
  add_schemes_as_printed("6.2", "printed equations", mass, rates, table);
}

std::array<Rate, 3> by_element(const std::array<double, 3>& alphas) {
  return {Rate{1, alphas[0]}, Rate{2, alphas[1]}, Rate{4, alphas[2]}};
}

// Tables 6.3 and 6.4: four seconds, and half-lives in seconds.
void add_ages(std::string_view of_table, const std::array<double, 3>& half_lives_s, Table& table) {
  const MassFunction mass(kElements, {{1, 0.3}, {2, 0.2}, {3, 0.2}, {4, 0.2}});
  const std::vector<double> left = left_after(4, decay_rates(half_lives_s));
  const std::array kappas{left[0], left[1], left[2]};
  const std::array lost{1 - left[0], 1 - left[1], 1 - left[2]};
  add_schemes(of_table, "meant", mass, by_element(lost), table);
  add_schemes(of_table, "kappa for alpha", mass, by_element(kappas), table);
  add_schemes_as_printed(of_table, "printed equations", mass, by_element(kappas), table);
  const std::vector<double> rates = contextual_rates(left);
  add_sets(of_table, "contextual", "meant",
           discounted_contextually(mass, by_element({rates[0], rates[1], rates[2]})), table);
}

}  // namespace

Tables evidential_tables(const Input& /*input*/) {
  Table table("evidential_discounting", {"of_table", "scheme", "reading", "set", "mass"});
  add_comparison(table);
  add_targets(table);
  add_ages("6.3", {1, 4, 15}, table);
  add_ages("6.4", {5, 4, 15}, table);
  return {std::move(table)};
}

}  // namespace iog::lab
