// Parts of the pages that the program writes, each a single file that refers to no other.
#pragma once

#include <string>
#include <string_view>

namespace supercoil::host_sim {

/// The text for an element or a quoted attribute; control characters, which HTML cannot have,
/// become U+FFFD.
std::string escaped(std::string_view text);

/// From the document's type to the opened body. Empty elements are closed: a page whose text has no
/// named entity is XML too, which a strict parser can check.
std::string page_begin(std::string_view title);
std::string page_end();

/// An image that holds the SVG, so that its identifiers stay its own. alt: what it shows.
std::string embedded_svg(std::string_view svg, std::string_view alt);

}  // namespace supercoil::host_sim
