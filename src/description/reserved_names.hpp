// Names that no car can have, because the build makes a C++ namespace of a car's name: the keywords
// of C++20 (ISO/IEC 14882:2020, 5.11), and the namespaces that generated headers speak of.
#pragma once

#include <cstddef>
#include <string_view>

namespace iog::description {

// Each before a blank.
inline constexpr std::string_view kReservedNames =
    "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t "
    "char32_t char8_t class co_await co_return co_yield compl concept const const_cast "
    "consteval constexpr constinit continue decltype default delete do double dynamic_cast "
    "else enum explicit export extern false float for friend goto if inline int long mutable "
    "namespace new noexcept not not_eq nullptr operator or or_eq private protected public "
    "register reinterpret_cast requires return short signed sizeof static static_assert "
    "static_cast struct switch template this thread_local throw true try typedef typeid "
    "typename union unsigned using virtual void volatile wchar_t while xor xor_eq Entry ageing "
    "description evidence index iog kAll kDescription kNetwork lidar map net pose std vehicle "
    "vehicles window ";

constexpr bool is_listed(std::string_view name) {
  std::string_view rest = kReservedNames;
  while (!rest.empty()) {
    const std::size_t length = rest.find(' ');
    if (rest.substr(0, length) == name) {
      return true;
    }
    rest.remove_prefix(length + 1);
  }
  return false;
}

// Of C++, or with "__", which is the compiler's.
constexpr bool is_reserved(std::string_view name) {
  return is_listed(name) || name.find("__") != std::string_view::npos || name.starts_with('_');
}

}  // namespace iog::description
