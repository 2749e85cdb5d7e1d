/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uses the installed C library: exits with 0 if two samples have a point between them. */
#include <isopoint.h>

#include <string.h>

int main(void)
{
  const float coordinates[] = { 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f };
  const float numbers[] = { 0.0f, 1.0f };
  const isopoint_array positions = { coordinates, ISOPOINT_FLOAT, 3, 2, 0, 0 };
  const isopoint_array values = { numbers, ISOPOINT_FLOAT, 1, 2, 0, 0 };
  const double isovalue = 0.25;
  isopoint_array points = { NULL, 0, 1, 0, 0, 0 };
  isopoint_surface* surface = NULL;
  isopoint_extractor* extractor = isopoint_create_extractor();
  const int failed = isopoint_set_samples(extractor, &positions, &values, NULL) ||
                     isopoint_extract(extractor, &isovalue, 1, NULL, &surface) ||
                     isopoint_get_array(surface, ISOPOINT_ARRAY_POINTS, &points);
  const int found = !failed && points.count == 1 && ((const float*)points.data)[0] == 0.25f;
  isopoint_destroy_surface(surface);
  isopoint_destroy_extractor(extractor);
  return found && strlen(isopoint_version()) >= 5 ? 0 : 1;
}
