// SPDX-License-Identifier: Apache-2.0

/** Why the page cannot read a file, for its user. */
export class Unreadable extends Error {}
