// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
int main() { return 0; }
