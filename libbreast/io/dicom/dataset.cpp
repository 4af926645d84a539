#include "io/dicom/dataset.hpp"

#include <gdcmSequenceOfItems.h>

#include <cstdio>

namespace breast {

namespace {
gdcm::Tag tag_of(std::uint32_t tag) {
  return {std::uint16_t(tag >> 16), std::uint16_t(tag & 0xffff)};
}
}  // namespace

DatasetBuilder& DatasetBuilder::bytes(std::uint32_t tag, gdcm::VR::VRType vr, const char* data,
                                      std::size_t n) {
  gdcm::DataElement element(tag_of(tag));
  element.SetVR(vr);
  element.SetByteValue(data, gdcm::VL(std::uint32_t(n)));
  set_.Replace(element);
  return *this;
}

DatasetBuilder& DatasetBuilder::text(std::uint32_t tag, gdcm::VR::VRType vr, std::string value) {
  if (value.size() % 2 != 0) value += vr == gdcm::VR::UI ? '\0' : ' ';
  return bytes(tag, vr, value.data(), value.size());
}

DatasetBuilder& DatasetBuilder::number(std::uint32_t tag, double value) {
  char text[17];  // DS holds 16 characters
  for (int digits = 10; digits > 0; --digits) {
    if (std::snprintf(text, sizeof text, "%.*g", digits, value) <= 16) break;
  }
  return this->text(tag, gdcm::VR::DS, text);
}

DatasetBuilder& DatasetBuilder::unsigned_short(std::uint32_t tag, std::uint16_t value) {
  return bytes(tag, gdcm::VR::US, reinterpret_cast<const char*>(&value), 2);
}

DatasetBuilder& DatasetBuilder::signed_short(std::uint32_t tag, std::int16_t value) {
  return bytes(tag, gdcm::VR::SS, reinterpret_cast<const char*>(&value), 2);
}

DatasetBuilder& DatasetBuilder::words(std::uint32_t tag, const std::vector<std::uint16_t>& values) {
  return bytes(tag, gdcm::VR::OW, reinterpret_cast<const char*>(values.data()), 2 * values.size());
}

DatasetBuilder& DatasetBuilder::sequence(std::uint32_t tag,
                                         const std::vector<gdcm::DataSet>& items) {
  gdcm::SmartPointer<gdcm::SequenceOfItems> list = new gdcm::SequenceOfItems;
  list->SetLengthToUndefined();
  for (const gdcm::DataSet& content : items) {
    gdcm::Item item;
    item.SetVLToUndefined();
    item.SetNestedDataSet(content);
    list->AddItem(item);
  }
  gdcm::DataElement element(tag_of(tag));
  element.SetVR(gdcm::VR::SQ);
  element.SetValue(*list);
  element.SetVLToUndefined();
  set_.Replace(element);
  return *this;
}

gdcm::DataSet code_item(const std::string& value, const std::string& scheme,
                        const std::string& meaning) {
  return DatasetBuilder()
      .text(0x00080100, gdcm::VR::SH, value)
      .text(0x00080102, gdcm::VR::SH, scheme)
      .text(0x00080104, gdcm::VR::LO, meaning)
      .set();
}

}  // namespace breast
