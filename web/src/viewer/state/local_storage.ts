// Preferences in the local storage of the browser; without effect where it is disabled.
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
    // storage is disabled
  }
}
