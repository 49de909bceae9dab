#pragma once

#include <string>

namespace holdfast::program {

/// An SVG text as a URL that holds it (RFC 2397). Its quotes, "#" and "%" are escaped: between
/// double quotes of HTML "&" alone is left to escape.
std::string svg_url(const std::string& svg);

/// The same of the bytes of a PNG.
std::string png_url(const std::string& png);

}  // namespace holdfast::program
