// What this browser remembers of its reader; nothing where it may not.
export function recall(name: string): string | null {
  try {
    return localStorage.getItem(`isoatlas-${name}`);
  } catch {
    return null;
  }
}

export function remember(name: string, text: string): void {
  try {
    localStorage.setItem(`isoatlas-${name}`, text);
  } catch {
    // then not
  }
}
