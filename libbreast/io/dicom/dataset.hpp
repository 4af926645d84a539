// Building DICOM data sets element by element; private to io/dicom.
#pragma once

#include <gdcmDataSet.h>

#include <cstdint>
#include <string>
#include <vector>

namespace breast {

class DatasetBuilder {
 public:
  /// `tag` as 0xGGGGEEEE. Texts are padded to even length as their type asks.
  DatasetBuilder& text(std::uint32_t tag, gdcm::VR::VRType vr, std::string value);
  DatasetBuilder& number(std::uint32_t tag, double value);  ///< DS
  DatasetBuilder& unsigned_short(std::uint32_t tag, std::uint16_t value);
  DatasetBuilder& signed_short(std::uint32_t tag, std::int16_t value);
  DatasetBuilder& words(std::uint32_t tag, const std::vector<std::uint16_t>& values);  ///< OW
  DatasetBuilder& sequence(std::uint32_t tag, const std::vector<gdcm::DataSet>& items);
  const gdcm::DataSet& set() const { return set_; }

 private:
  DatasetBuilder& bytes(std::uint32_t tag, gdcm::VR::VRType vr, const char* data, std::size_t n);
  gdcm::DataSet set_;
};

/// An item of a code sequence: value, scheme and meaning, with further elements.
gdcm::DataSet code_item(const std::string& value, const std::string& scheme,
                        const std::string& meaning);

}  // namespace breast
