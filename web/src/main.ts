document.title = 'Swiftlet';
