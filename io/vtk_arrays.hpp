/// From and to VTK's arrays. Included by the .cpp files of this folder only.
#pragma once

#include "core/tensor.hpp"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <string>
#include <vector>

namespace tessera::io {

/// An array of VTK's type `Array` with value(i, c) in component c of tuple i.
template <class Array, class Value>
vtkSmartPointer<Array> make_array(const std::string& name, int components, std::int64_t tuples,
                                  Value&& value) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  for (std::int64_t i = 0; i < tuples; ++i)
    for (int c = 0; c < components; ++c)
      array->SetValue(i * components + c, static_cast<typename Array::ValueType>(value(i, c)));
  return array;
}

/// A field array holding one number.
template <class Array, class Value>
vtkSmartPointer<Array> make_value(const std::string& name, Value value) {
  return make_array<Array>(name, 1, 1, [&](std::int64_t, int) { return value; });
}

} // namespace tessera::io
